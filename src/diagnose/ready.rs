//! Records as they are diagnosed: without sparks, at even steps, and no more samples of them than tell something.

use super::judged_channel::form;
use crate::identify::Form;
use crate::record::Record;
use crate::record::evened::evened;
use crate::record::jolts::felt;
use crate::record::outliers::struck_out;
use crate::record::thinned::thinned;

/// Samples of all records together beyond which densely sampled cycles are thinned.
const MANY: usize = 30_000;

/// Records made ready.
pub(super) struct Ready {
    /// The records.
    pub records: Vec<Record>,
    /// Names of those that are off an even clock.
    pub uneven: Vec<String>,
    /// Which channel drives, once for all: what is taken off one channel makes the other look like the drive.
    pub form: Form,
}

/// Strikes out what stands alone, but for jolts of a load that drives, and brings the records to even steps.
pub(super) fn ready(given: &[Record]) -> Ready {
    let struck: Vec<Record> = given.iter().map(struck_out).collect();
    let ready = Ready::of(&struck);
    let thin = ready
        .records
        .iter()
        .zip(given)
        .any(|(r, g)| r.len() < g.len());
    // A jolt lasts for a sample: of few samples it would be another.
    if ready.form == Form::Stop || thin {
        return ready;
    }
    let both = given.iter().zip(&struck);
    let jolted: Vec<Option<Record>> = both.map(|(given, struck)| felt(given, struck)).collect();
    if jolted.iter().all(Option::is_none) {
        return ready;
    }
    let both = jolted.into_iter().zip(struck);
    let records: Vec<Record> = both.map(|(felt, struck)| felt.unwrap_or(struck)).collect();
    Ready {
        form: ready.form,
        ..Ready::of(&records)
    }
}

impl Ready {
    fn of(records: &[Record]) -> Ready {
        let all: usize = records.iter().map(Record::len).sum();
        let even: Vec<(Record, bool)> = records
            .iter()
            .map(|r| evened(r).map_or((r.clone(), false), |even| (even, true)))
            .collect();
        let uneven = even.iter().filter(|(_, uneven)| *uneven);
        let uneven = uneven.map(|(r, _)| r.name.clone()).collect();
        let most = |r: &Record| MANY * r.len() / all.max(1);
        let records: Vec<Record> = even
            .into_iter()
            .map(|(r, _)| thinned(&r, most(&r)).unwrap_or(r))
            .collect();
        Ready {
            form: form(&records),
            records,
            uneven,
        }
    }
}
