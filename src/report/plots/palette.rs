//! Colours that colour-blind readers tell apart (Okabe and Ito), on light and on dark ground.
//!
//! The style sheet of the page repeats them by value to lighten them on dark ground.

use plotters::style::RGBColor;

/// Measured curves.
pub(super) const MEASURED: RGBColor = RGBColor(0x8A, 0x8F, 0x98);
/// The baseline joint: vermilion.
pub(super) const BASELINE: RGBColor = RGBColor(0xD5, 0x5E, 0x00);
/// The extended joint: blue.
pub(super) const EXTENDED: RGBColor = RGBColor(0x00, 0x72, 0xB2);
/// The band of the noise: bluish green.
pub(super) const NOISE: RGBColor = RGBColor(0x00, 0x9E, 0x73);
/// Data that no fit has seen: yellow.
pub(super) const HELD_OUT: RGBColor = RGBColor(0xF0, 0xE4, 0x42);
/// Axes and grid.
pub(super) const AXIS: RGBColor = RGBColor(0x8C, 0x93, 0x9E);
/// Text; the style sheet gives it the page's ink.
pub(super) const INK: RGBColor = RGBColor(0x33, 0x3A, 0x45);

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_style_sheet_knows_the_colours_it_lightens() {
        let style = include_str!("../report.css");
        for RGBColor(red, green, blue) in [MEASURED, BASELINE, EXTENDED] {
            for attribute in ["stroke", "fill"] {
                let selector = format!(".plot [{attribute}=\"#{red:02X}{green:02X}{blue:02X}\"]");
                assert!(style.contains(&selector), "{selector}");
            }
        }
    }
}
