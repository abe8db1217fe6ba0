//! Samples that stand alone in what the baseline leaves, struck out before any cause is fitted to them.

use crate::identify::{Fit, Form, Problem};
use crate::record::outliers::{Neighbours, outliers, scattered};

/// Strikes out samples of the judged channel that stand alone in what the baseline leaves; true
/// where there are any.
pub(super) fn strike_residuals(
    problem: &mut Problem,
    first: &Fit,
    struck: &mut [Vec<bool>],
) -> bool {
    let predictions = first.predict(problem);
    let form = problem.operators.form;
    let mut any = false;
    for (k, record) in problem.records.iter_mut().enumerate() {
        let (drive, judged) = match form {
            Form::Play => (&record.force, &mut record.displacement),
            Form::Stop => (&record.displacement, &mut record.force),
        };
        let predicted = &predictions[k].judged;
        let residual: Vec<f64> = judged.iter().zip(predicted).map(|(y, p)| y - p).collect();
        for (i, instead) in scattered(outliers(&residual, Neighbours::Level), drive) {
            judged[i] = predicted[i] + instead;
            struck[k][i] = true;
            record.weight[i] = 0.0;
            any = true;
        }
    }
    any
}
