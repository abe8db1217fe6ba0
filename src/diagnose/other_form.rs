//! Records of which neither channel is plainly the quieter, seen in the other form as well.

use super::drawn_drives::Drives;
use super::investigation::Investigation;
use super::judged_channel::other_form;
use super::prepare::Bench;
use super::search::Found;
use super::sober::Kept;
use super::trials::alarm;
use super::unseen_events::investigated;
use super::without_drive_noise;
use crate::identify::Form;
use crate::record::Record;

/// Times the evidence that a cause must have beyond which the other form is not asked: what brings that much was never seen to
/// be missing there.
const PLAIN: f64 = 15.0;

/// Records in the form they were searched in, and what was found.
pub(super) struct Seen {
    pub form: Form,
    pub calm: Vec<Record>,
    pub investigation: Investigation,
    /// Causes of the other form that nothing is seen of in this one.
    pub unseen: Vec<String>,
}

impl Seen {
    /// Records that were searched in one form so far.
    pub fn once(form: Form, calm: Vec<Record>, investigation: Investigation) -> Seen {
        Seen {
            form,
            calm,
            investigation,
            unseen: Vec::new(),
        }
    }
}

/// What was found, or the other form where noise alone is left in that and no cause: of a channel that drives noise is
/// answered by sliders that stick, or turn, and looks like a cause of little evidence, which the other form knows nothing of.
///
/// A cause that is at work is seen in both: by evidence `E` in one and about `E (s/s′)²` in the other, with s and s′ the
/// noise of the judged channels as shares of what they do. Asked is where that is as much as a cause must have, and `E` no more
/// than [`PLAIN`] times as much.
pub(super) fn seen_from_both(
    records: &[Record],
    seen: Seen,
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Seen {
    let Investigation { bench, found } = &seen.investigation;
    let (evidence, wanted) = (found.brings(&bench.train), alarm(&bench.train));
    if found.names_none() || evidence >= PLAIN * wanted {
        return seen;
    }
    let Some((form, quieter_by)) = other_form(records, seen.form) else {
        return seen;
    };
    let shows = evidence / quieter_by.powi(2) > wanted;
    if !shows || kept(records, bench, found, timed).names_none() {
        return seen;
    }
    progress("once more: neither channel is the quieter one, and the other may drive");
    match nothing_at_work(records, form, timed, progress) {
        Some(other) => Seen {
            unseen: names(&seen.investigation.found),
            ..other
        },
        None => seen,
    }
}

/// What is found in a form, where that is no cause and noise alone is left.
fn nothing_at_work(
    records: &[Record],
    form: Form,
    timed: bool,
    progress: &mut impl FnMut(&str),
) -> Option<Seen> {
    let calm = without_drive_noise(form, records);
    let mut other = investigated((form, &calm), timed, progress);
    other.found = kept(records, &other.bench, &other.found, timed);
    other.is_plain().then(|| Seen::once(form, calm, other))
}

fn names(found: &Found) -> Vec<String> {
    let named = found.best.effects.iter();
    named.map(|a| a.effect.name().to_string()).collect()
}

/// What stays of a set: what noise of a drive makes is no cause in either form, nor the least bad of wrong explanations.
fn kept(records: &[Record], bench: &Bench, found: &Found, timed: bool) -> Found {
    let drives = Drives::of(records, bench);
    Kept::of(drives.as_ref(), bench, found.clone(), timed).found
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnose::diagnose;
    use crate::diagnose::gridded::tests::slid;
    use crate::record::noise::tests::drawn;

    /// Five sines that come and go, of a joint of sliders beside a spring that hardens, with noise as loud in both channels.
    fn swung(seed: u64, hardens: f64) -> Record {
        let mut random = drawn(seed);
        let mut white = || (0..12).map(|_| random()).sum::<f64>() - 6.0;
        let limits: Vec<f64> = (1..=40).map(|j| 0.03 * f64::from(j)).collect();
        let swings = |i: usize| {
            let t = i as f64 / 32.0;
            let sines = (1..=5).map(|k| (std::f64::consts::TAU * 0.23 * f64::from(k) * t).sin());
            (t / 10.0).min(1.0) * 0.3 * sines.sum::<f64>()
        };
        let displacement: Vec<f64> = (0..1200).map(swings).collect();
        let force = slid(&limits, &displacement).into_iter();
        let both = force.zip(&displacement);
        let hardened = both.map(|(f, u)| f + hardens * u.powi(3));
        let noisy: Vec<f64> = hardened.map(|f| f + 0.07 * white()).collect();
        Record {
            name: "swung".to_string(),
            force: noisy,
            displacement: displacement.iter().map(|u| u + 0.003 * white()).collect(),
            time: Some((0..1200).map(|i| 0.01 * i as f64).collect()),
            ..Record::default()
        }
    }

    #[test]
    fn what_is_at_work_is_seen_with_either_channel_driving() {
        let hardened = [swung(4, 3.0)];
        for form in [Form::Play, Form::Stop] {
            assert!(other_form(&hardened, form).is_some(), "not alike");
            assert!(nothing_at_work(&hardened, form, true, &mut |_| {}).is_none());
        }
        let clean = nothing_at_work(&[swung(4, 0.0)], Form::Stop, true, &mut |_| {});
        assert!(clean.is_some_and(|seen| seen.investigation.is_plain()));
    }

    /// A channel that is plainly the quieter one drives, whatever the other form says.
    #[test]
    fn a_quiet_drive_is_asked_no_second_time() {
        let record = swung(4, 0.0);
        let other = |record: &Record| other_form(std::slice::from_ref(record), Form::Play);
        let asked = |record: &Record| other(record).map(|(form, _)| form);
        assert_eq!(asked(&record), Some(Form::Stop));
        let smooth = (0..1200).map(|i| (0.05 * f64::from(i)).sin()).collect();
        let quiet = Record {
            displacement: smooth,
            ..record
        };
        assert_eq!(asked(&quiet), None);
    }

    /// Random loads of three levels on sliders, a force read in coarse steps and noise in the displacement.
    fn loads(seed: u64) -> Vec<Record> {
        let mut random = drawn(seed);
        let mut limits = Vec::new();
        for _ in 0..40 {
            let normal = (0..12).map(|_| random()).sum::<f64>() - 6.0;
            limits.push(0.35 * (1.2 * normal).exp());
        }
        let one = |(amplitude, cycle): (f64, f64)| {
            let sines: Vec<[f64; 3]> = (0..12)
                .map(|k| {
                    let rate = std::f64::consts::TAU / cycle * (0.15 + 0.1 * f64::from(k));
                    [rate, std::f64::consts::TAU * random(), 0.5 + random()]
                })
                .collect();
            let at = |i: usize| {
                let of = |[rate, phase, size]: &[f64; 3]| size * (rate * i as f64 + phase).sin();
                (i as f64 / 20.0).min(1.0) * sines.iter().map(of).sum::<f64>()
            };
            let raw: Vec<f64> = (0..375).map(at).collect();
            let largest = raw.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let displacement: Vec<f64> = raw.iter().map(|x| amplitude * x / largest).collect();
            let force = slid(&limits, &displacement);
            let mut read = |u: &f64| {
                let white = (0..12).map(|_| random()).sum::<f64>() - 6.0;
                u + 0.0022 * (1.0 + 1.5 * u.abs()) * white
            };
            Record {
                name: format!("at {amplitude}"),
                displacement: displacement.iter().map(&mut read).collect(),
                force: force.iter().map(|f| (f / 0.19).round() * 0.19).collect(),
                time: Some((0..375).map(|i| 0.2 * f64::from(i)).collect()),
                ..Record::default()
            }
        };
        [(1.0, 32.0), (0.73, 32.0), (0.47, 41.0)].map(one).to_vec()
    }

    /// Two of forty clean campaigns that had up to three causes with the force driving: the second has none any more since
    /// its drive is calmed at its turns.
    #[test]
    fn what_one_form_alone_shows_is_not_named() {
        for (seed, one_form_shows) in [(6, true), (15, false)] {
            let found = diagnose(&loads(seed), |_| {}).unwrap();
            let names: Vec<&str> = found.causes.iter().map(|c| c.name.as_str()).collect();
            assert!(names.is_empty(), "{seed}: {names:?}");
            let said = |n: &String| n.contains("neither channel is plainly the quieter");
            let any_said = found.notes.iter().any(said);
            assert_eq!(any_said, one_form_shows, "{seed}: {:?}", found.notes);
        }
    }
}
