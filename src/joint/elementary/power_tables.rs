//! Tables of the power function, computed by the compiler in pairs of doubles (106 bits).

/// Parts into which an octave is cut, for the logarithm and for the exponential.
pub(super) const PARTS: usize = 128;
/// Bits of the lower end of the octave `[0.7, 1.4)`; 1 lies inside a part, not between two.
pub(super) const OCTAVE: u64 = 0x3fe6_9555_0000_0000;
/// Bits below the index of a part.
pub(super) const PART_BITS: u32 = 45;

/// One part of the octave around its middle c.
#[derive(Clone, Copy)]
pub(super) struct LogarithmPart {
    /// `1/c`, of ten bits, so that products with the half of a double are exact.
    pub inverse: f64,
    /// `ln c` in multiples of 2⁻⁴², so that sums with multiples of ln 2 are exact.
    pub head: f64,
    /// What `head` leaves of `ln c`.
    pub tail: f64,
}

/// `2^(j/128)` as `head (1 + tail)`.
#[derive(Clone, Copy)]
pub(super) struct ExponentialPart {
    pub head: f64,
    pub tail: f64,
}

pub(super) static LOGARITHM: [LogarithmPart; PARTS] = logarithm_parts();
pub(super) static EXPONENTIAL: [ExponentialPart; PARTS] = exponential_parts();

/// ln 2 in multiples of 2⁻⁴².
pub(super) const LN_2_HEAD: f64 = fixed(LN_2.0);
/// What [`LN_2_HEAD`] leaves.
pub(super) const LN_2_TAIL: f64 = (LN_2.0 - LN_2_HEAD) + LN_2.1;
/// `ln 2 / 128` in multiples of 2⁻⁴²: few enough bits for an exact product with any step count.
pub(super) const PART_HEAD: f64 = fixed(LN_2.0 / PARTS as f64);
/// What [`PART_HEAD`] leaves.
pub(super) const PART_TAIL: f64 = (LN_2.0 / PARTS as f64 - PART_HEAD) + LN_2.1 / PARTS as f64;

/// A number as the unevaluated sum of two doubles.
type Pair = (f64, f64);

const LN_2: Pair = logarithm(2.0);

const fn fixed(x: f64) -> f64 {
    // 1.5 · 2^(52 − 42): the last place of sums with it is 2⁻⁴².
    (x + 1536.0) - 1536.0
}

const fn sum(a: f64, b: f64) -> Pair {
    let s = a + b;
    let v = s - a;
    (s, (a - (s - v)) + (b - v))
}

const fn add(a: Pair, b: Pair) -> Pair {
    let (s, e) = sum(a.0, b.0);
    sum(s, e + (a.1 + b.1))
}

/// Dekker's product.
const fn product(a: f64, b: f64) -> Pair {
    let (ca, cb) = (134217729.0 * a, 134217729.0 * b);
    let (ah, bh) = (ca - (ca - a), cb - (cb - b));
    let (al, bl) = (a - ah, b - bh);
    let p = a * b;
    (p, ((ah * bh - p) + ah * bl + al * bh) + al * bl)
}

const fn multiply(a: Pair, b: Pair) -> Pair {
    let (p, e) = product(a.0, b.0);
    sum(p, e + (a.0 * b.1 + a.1 * b.0))
}

const fn divide(a: Pair, by: f64) -> Pair {
    let first = a.0 / by;
    let (p, e) = product(first, by);
    sum(first, (((a.0 - p) - e) + a.1) / by)
}

/// `ln m = 2 artanh((m−1)/(m+1))` for m in `[1/2, 2]` of few bits.
const fn logarithm(m: f64) -> Pair {
    let s = divide((m - 1.0, 0.0), m + 1.0);
    let squared = multiply(s, s);
    let (mut term, mut total, mut n) = (s, s, 1);
    // (1/3)^(2·36) < 2⁻¹¹⁴
    while n < 36 {
        term = multiply(term, squared);
        total = add(total, divide(term, (2 * n + 1) as f64));
        n += 1;
    }
    (2.0 * total.0, 2.0 * total.1)
}

const fn logarithm_parts() -> [LogarithmPart; PARTS] {
    let one = LogarithmPart {
        inverse: 1.0,
        head: 0.0,
        tail: 0.0,
    };
    let mut parts = [one; PARTS];
    let mut i = 0;
    while i < PARTS {
        let low = OCTAVE + ((i as u64) << PART_BITS);
        let high = low + (1 << PART_BITS);
        // Around 1 the logarithm is small and must keep its digits: no ln c beside it.
        if high <= 1.0_f64.to_bits() || low > 1.0_f64.to_bits() {
            let middle = 0.5 * (f64::from_bits(low) + f64::from_bits(high));
            let inverse = ((1024.0 / middle + 0.5) as u64) as f64 / 1024.0;
            let (head, tail) = logarithm(inverse);
            let fixed = fixed(-head);
            parts[i] = LogarithmPart {
                inverse,
                head: fixed,
                tail: (-head - fixed) - tail,
            };
        }
        i += 1;
    }
    parts
}

const fn exponential_parts() -> [ExponentialPart; PARTS] {
    // 2^(1/128) by its series: 0.0054^14/14! < 2⁻¹¹⁰
    let x = (LN_2.0 / PARTS as f64, LN_2.1 / PARTS as f64);
    let (mut term, mut step, mut n) = ((1.0, 0.0), (1.0, 0.0), 1);
    while n < 14 {
        term = divide(multiply(term, x), n as f64);
        step = add(step, term);
        n += 1;
    }
    let mut parts = [ExponentialPart {
        head: 1.0,
        tail: 0.0,
    }; PARTS];
    let (mut value, mut j) = ((1.0, 0.0), 0);
    while j < PARTS {
        parts[j] = ExponentialPart {
            head: value.0,
            tail: value.1 / value.0,
        };
        value = multiply(value, step);
        j += 1;
    }
    parts
}
