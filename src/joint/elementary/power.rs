//! `x^y` as `exp(y ln x)`, the logarithm in two doubles.

use super::power_tables::{
    EXPONENTIAL, LN_2_HEAD, LN_2_TAIL, LOGARITHM, OCTAVE, PART_BITS, PART_HEAD, PART_TAIL, PARTS,
};

/// The exponents of the joint lie below χ + 3 = 7; beyond this the logarithm has too few digits.
const LARGEST_EXPONENT: f64 = 16.0;
/// Largest `|y ln x|`: the result stays clear of overflow and of the subnormal numbers.
const LARGEST_LOGARITHM: f64 = 700.0;
/// Added and taken away again, rounds to whole numbers.
const TO_WHOLE: f64 = 6_755_399_441_055_744.0;
/// Upper 26 of a double's 53 bits: products of two such halves are exact.
const UPPER_HALF: u64 = u64::MAX << 27;

/// `x^y` to the last bit or the one beside it, the same on every platform.
///
/// The method is that of the power in Arm's optimized routines (S. Nagy, 2018), which glibc and musl
/// use; here with tables made by the compiler and without fused operations. Whatever is not the
/// power of a positive normal number with a moderate exponent and result goes to `libm`. Checked
/// below against both `libm` and the platform's `powf`.
#[inline]
pub fn power(x: f64, y: f64) -> f64 {
    if !((f64::MIN_POSITIVE..=f64::MAX).contains(&x) && y.abs() <= LARGEST_EXPONENT) {
        return libm::pow(x, y);
    }
    let (head, tail) = logarithm(x);
    let upper = f64::from_bits(y.to_bits() & UPPER_HALF);
    let carried = f64::from_bits(head.to_bits() & UPPER_HALF);
    let large = upper * carried;
    let small = (y - upper) * carried + y * (head - carried + tail);
    if large.abs() <= LARGEST_LOGARITHM {
        exponential(large, small)
    } else {
        libm::pow(x, y)
    }
}

/// `ln x` of a positive normal number as the sum of two doubles, to 2⁻⁶⁰ absolutely.
#[inline]
fn logarithm(x: f64) -> (f64, f64) {
    // x = 2^k z, z in the octave around 1, and in it ln z = ln c + ln(1 + r) with r = z/c − 1.
    let bits = x.to_bits();
    let above = bits.wrapping_sub(OCTAVE);
    let part = &LOGARITHM[(above >> PART_BITS) as usize % PARTS];
    let octaves = ((above as i64) >> 52) as f64;
    let within = bits.wrapping_sub(above & (0xfff << 52));
    let z = f64::from_bits(within);
    // The upper 21 bits of z give an exact product and an exact square.
    let z_head = f64::from_bits((within + (1 << 31)) & (u64::MAX << 32));
    let r_head = z_head * part.inverse - 1.0;
    let r_tail = (z - z_head) * part.inverse;
    let r = r_head + r_tail;

    let whole = octaves * LN_2_HEAD + part.head;
    let with_r = whole + r;
    let half_square = -0.5 * r_head * r_head;
    let head = with_r + half_square;
    let square = r * r;
    // ln(1 + r) = r − r²/2 + …; |r| < 0.0054: r⁹/9 is below 2⁻⁷⁰.
    let cubic = 1.0 / 3.0 - r * 0.25
        + square * (0.2 - r * (1.0 / 6.0))
        + square * square * (1.0 / 7.0 - r * 0.125);
    let left =
        (octaves * LN_2_TAIL + part.tail) + (whole - with_r + r) + (with_r - head + half_square)
            - 0.5 * r_tail * (r + r_head)
            + r * square * cubic;
    let sum = head + left;
    (sum, head - sum + left)
}

/// `exp(large + small)` for `|large|` up to 700 and a small remainder.
#[inline]
fn exponential(large: f64, small: f64) -> f64 {
    // = 2^(k/128) exp(r), |r| < 0.0028: r⁶/720 is below 2⁻⁶⁰.
    let steps = (large * (PARTS as f64 / std::f64::consts::LN_2) + TO_WHOLE) - TO_WHOLE;
    let r = (large - steps * PART_HEAD) - steps * PART_TAIL + small;
    let count = steps as i64;
    let part = &EXPONENTIAL[count as usize % PARTS];
    let octaves = count >> PARTS.trailing_zeros();
    let scale = f64::from_bits(part.head.to_bits().wrapping_add((octaves << 52) as u64));
    let square = r * r;
    let above_one = part.tail
        + r
        + square * (0.5 + r * (1.0 / 6.0))
        + square * square * (1.0 / 24.0 + r * (1.0 / 120.0));
    scale + scale * above_one
}

#[cfg(test)]
mod tests {
    use super::power;

    /// Distance in units in the last place.
    fn apart(a: f64, b: f64) -> u64 {
        a.to_bits().abs_diff(b.to_bits())
    }

    #[test]
    fn differs_from_two_other_powers_by_the_last_bit_at_most() {
        let (mut x, mut different) = (1e-300_f64, 0);
        for i in 0..200_000 {
            x *= 1.006_931_5 + 1e-9 * f64::from(i);
            if x > 1e300 {
                x *= 1e-280;
            }
            let y = 0.001 + 7.0 * f64::from(i * 7919 % 9973) / 9973.0;
            let y = if i % 5 == 0 { -y } else { y };
            let (ours, other, own) = (power(x, y), libm::pow(x, y), x.powf(y));
            assert!(apart(ours, other) <= 1, "{x:e}^{y}: {ours:e}, {other:e}");
            assert!(apart(ours, own) <= 1, "{x:e}^{y}: {ours:e}, {own:e}");
            different += u32::from(ours != own);
        }
        // Rounded to nearest in nearly all cases, both agree in nearly all.
        assert!(different < 10_000, "{different} differ");
    }

    #[test]
    fn near_one_no_digit_is_lost() {
        for i in 1..20_000 {
            let x = 1.0 + f64::from(i - 10_000) * 1.7e-6;
            let (ours, own) = (power(x, 0.6), x.powf(0.6));
            assert!(apart(ours, own) <= 1, "{x}: {ours}, {own}");
        }
        assert_eq!(power(1.0, 2.6), 1.0);
        assert_eq!(power(0.7, 0.0), 1.0);
    }

    #[test]
    fn whole_powers_of_two_are_exact() {
        for k in -40_i32..40 {
            let x = 2.0_f64.powi(k);
            assert_eq!(power(x, 3.0), 2.0_f64.powi(3 * k));
            assert_eq!(power(4.0_f64.powi(k), 1.5), 2.0_f64.powi(3 * k));
            assert_eq!(power(3.0, 3.0), 27.0);
        }
    }

    #[test]
    fn what_is_out_of_the_ordinary_is_as_in_the_standard() {
        let values = [
            0.0,
            -0.0,
            5e-324,
            1e-310,
            1e308,
            f64::INFINITY,
            f64::NAN,
            -2.0,
        ];
        for x in values {
            for y in [0.0, 0.6, 2.0, 3.0, -1.5, 1e3, f64::INFINITY, f64::NAN] {
                let (ours, own) = (power(x, y), x.powf(y));
                assert!(ours == own || apart(ours, own) <= 1 || (ours.is_nan() && own.is_nan()));
            }
        }
    }
}
