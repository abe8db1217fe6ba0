//! Elementary functions with the same digits on every platform and processor.
//!
//! The standard library takes `powf`, `exp`, `ln` and their kin from the platform's C library, and
//! glibc, msvcrt and musl differ in the last bit: the same FMU would answer differently under Windows
//! and Linux. These are made of additions and multiplications that IEEE 754 fixes to the bit: by the
//! package `libm`, and the power, of which every step takes several, by [`power`]: with `libm`'s a
//! step of the exact response took twice the time (`cargo bench --bench joint`). `powi` may multiply
//! in any order and is replaced by [`square`] and [`cube`]. `sqrt`, `abs`, `min` and the four
//! operations are exact as they are.
//!
//! tests/architecture.rs keeps the others out of `joint/` and `causes/`; scripts/build-platforms.sh
//! compares the platforms bit for bit.

mod power;
mod power_tables;

pub use libm::{exp, exp2, expm1, hypot, log, log1p, sin, sincos, tanh};
pub use power::power;

/// `x²`.
#[inline]
pub fn square(x: f64) -> f64 {
    x * x
}

/// `x³`, as `x² x`.
#[inline]
pub fn cube(x: f64) -> f64 {
    x * x * x
}
