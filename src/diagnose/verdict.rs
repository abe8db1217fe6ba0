//! From fits and structure to a verdict.

use super::findings::Verdict;
use super::noise_alone::OfNoise;
use super::structure::Structure;

/// Standard deviations of the bins' means beyond which structure is there: with tens of bins the
/// chance of noise alone is below one in a million, which leaves room for noise that is not quite
/// what it was taken for.
const STRUCTURED: f64 = 6.0;

/// Structure, as a share of the noise variance, below which it is no concern: a tenth of the
/// noise in rms is 0.01.
pub const NEGLIGIBLE: f64 = 0.02;

/// Share of the baseline's structure that may be left by a cause whose law is only nearly right.
const LEFT: f64 = 0.04;

/// What a model leaves over the noise's variance beyond which it is no noise, however random: three times what
/// repeated cycles or its fast part show of it in rms.
const THRICE: f64 = 9.0;

/// Probability of something that is not in the catalogue above which no name explains a record: as
/// often a wrong one may.
const UNSURE: f64 = 0.1;

/// The verdict, from what baseline and extended model leave.
///
/// `named` is `None` where no cause is; else whether the gain on held-out data is beyond its
/// scatter, without which nothing counts as explained. `most` bounds `chi`, what the model leaves
/// over the noise's variance, where the noise is known on its own; `unlisted` is the probability of
/// something that is not in the catalogue, `toned` is true where a tone is left that cycles do not repeat, and `outside` where a
/// law outside the catalogue is likelier than no cause; `read` is true where the noise was taken for what the channels
/// resolve, and noise of the drives alone leaves as much as `of_noise` says.
pub fn verdict(
    named: Option<bool>,
    before: &Structure,
    after: &Structure,
    (most, read, of_noise): (Option<f64>, bool, OfNoise),
    chi: f64,
    (unlisted, toned, outside): (f64, bool, bool),
) -> Verdict {
    // Beneath what a channel resolves nobody asks what is left.
    let shows = !read || chi > 1.0;
    // What differs between cycles was taken for noise, a tone with it.
    let structured = after.significance > STRUCTURED && after.share > NEGLIGIBLE;
    let structured = structured && !of_noise.leaves_as_structured(after.share);
    let left = toned || shows && structured;
    // Where cycles repeat, the noise is known on its own and the sum of squares tells too, unless what
    // is left is as random as noise: noise that grows with the load is. A few large errors in every bin
    // hide that the bins differ.
    let over = most.is_some_and(|most| chi > most) && (after.is_seen() || chi > THRICE);
    let over = over && !of_noise.leaves_as_much(chi);
    match (named, left || over) {
        // Noise that is told by its fast part alone may still be far less than what is left.
        (None, false) if chi <= THRICE && !outside => Verdict::Clean,
        (None, _) => Verdict::Unexplained,
        (Some(_), _) if unlisted > UNSURE => Verdict::PartlyExplained,
        (Some(true), false) => Verdict::Explained,
        (Some(true), true) if after.share <= LEFT * before.share && !over => Verdict::Explained,
        (Some(_), _) => Verdict::PartlyExplained,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left as random as noise.
    fn random() -> Structure {
        Structure {
            share: 0.0,
            error: 0.0,
            significance: -9.0,
            correlation: 0.05,
            ringing: 0.0,
            places: Vec::new(),
        }
    }

    #[test]
    fn nothing_that_is_many_times_the_known_noise_is_clean() {
        let random = random();
        let said = |most, chi| {
            let others = (0.0, false, false);
            verdict(
                None,
                &random,
                &random,
                (most, false, OfNoise::default()),
                chi,
                others,
            )
        };
        assert_eq!(said(Some(1.4), 15.0), Verdict::Unexplained);
        // Noise that grows with the load is known too small.
        assert_eq!(said(Some(1.4), 3.0), Verdict::Clean);
        // Where nothing repeats the noise is what is left, or its fast part, which may be far less.
        assert_eq!(said(None, 8.0), Verdict::Clean);
        assert_eq!(said(None, 15.0), Verdict::Unexplained);
    }

    /// As random as noise may be what a law outside the catalogue explains.
    #[test]
    fn what_another_law_explains_is_not_clean() {
        let random = random();
        let said = |outside| {
            let others = (0.0, false, outside);
            verdict(
                None,
                &random,
                &random,
                (None, false, OfNoise::default()),
                1.0,
                others,
            )
        };
        assert_eq!(said(false), Verdict::Clean);
        assert_eq!(said(true), Verdict::Unexplained);
    }

    /// The grid of the dictionary leaves a pattern of a hundredth of what a noise-free channel resolves.
    #[test]
    fn a_pattern_beneath_what_is_read_is_no_concern() {
        let pattern = Structure {
            share: 0.5,
            error: 0.01,
            significance: 50.0,
            correlation: 0.9,
            ringing: 0.0,
            places: Vec::new(),
        };
        let said = |read, chi| {
            let others = (0.0, false, false);
            verdict(
                None,
                &pattern,
                &pattern,
                (None, read, OfNoise::default()),
                chi,
                others,
            )
        };
        assert_eq!(said(true, 0.01), Verdict::Clean);
        assert_eq!(said(true, 1.5), Verdict::Unexplained);
        assert_eq!(said(false, 0.9), Verdict::Unexplained);
    }

    /// Structure of a twentieth of the noise, and a quarter more left than that.
    #[test]
    fn what_noise_of_the_drives_leaves_by_itself_is_clean() {
        let pattern = Structure {
            share: 0.05,
            significance: 8.0,
            ..random()
        };
        let said = |share, beyond| {
            let of_noise = OfNoise { share, beyond };
            let others = (0.0, false, false);
            verdict(
                None,
                &pattern,
                &pattern,
                (Some(1.2), false, of_noise),
                1.25,
                others,
            )
        };
        assert_eq!(said(0.0, 0.0), Verdict::Unexplained);
        assert_eq!(said(0.03, 0.2), Verdict::Clean);
        assert_eq!(said(0.02, 0.2), Verdict::Unexplained);
        assert_eq!(said(0.03, 0.1), Verdict::Unexplained);
    }
}
