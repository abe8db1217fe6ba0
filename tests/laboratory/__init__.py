"""Virtual laboratory: test records with known hidden effects, made by means of its own."""
