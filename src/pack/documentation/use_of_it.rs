//! How to use the unit in importers.

use crate::joint::Drive;
use crate::pack::{Experiment, FmiVersion};
use crate::saved::Provenance;
use std::fmt::Write as _;

/// The section.
pub fn section(page: &mut String, version: FmiVersion, drive: Drive, provenance: &Provenance) {
    let (input, output) = match drive {
        Drive::Force => ("force", "displacement"),
        Drive::Displacement => ("displacement", "force"),
    };
    let Experiment {
        stop_time,
        step_size,
    } = Experiment::of(provenance);
    let step = match version {
        FmiVersion::Two => "fmi2DoStep",
        FmiVersion::Three => "fmi3DoStep",
    };
    let _ = writeln!(
        page,
        "<h2>Use</h2>\n<p>Input <code>{input}</code>, answer <code>{output}</code>. The value of \
         <code>{input}</code> that is set before {step} is its value at the <em>end</em> of the \
         step.</p>"
    );
    derivatives(page, version, input);
    let _ = writeln!(
        page,
        "<p>Step: any length. What counts is that the turning values of the input fall on \
         communication points: a sine seen 20 times per cycle dissipates 1.3 % too little, seen \
         100 times 0.05 %. <code>iwan check JOINT.fmu RECORD</code> says it for a record, and what \
         causes add that follow what the joint does.</p>"
    );
    let _ = writeln!(
        page,
        "<ul>\n\
         <li>fmpy: <code>fmpy simulate joint.fmu --interface-type CoSimulation --input-file \
         load.csv --stop-time {stop_time} --output-interval {step_size} --output-file out.csv</code>; \
         the column of the load is <code>{input}</code></li>\n\
         <li>Simulink: block <em>FMU</em>, communication step {step_size} s, a multiple of the \
         solver's; parameters are in the block's dialog</li>\n\
         <li>Modelica tools that import co-simulation units: connect <code>{input}</code> to the \
         output of a block; a joint between two flanges takes <code>--drive displacement</code>\
         </li>\n\
         <li>Rigs: one instance per joint; a step has no file access and no lock; parameters \
         before the start</li>\n</ul>\n\
         <p>The complete state can be saved, put back, serialized and continued in another \
         process; any number of instances run in one.</p>"
    );
}

/// Which derivatives go in and come out, by version.
fn derivatives(page: &mut String, version: FmiVersion, input: &str) {
    let (directional, outputs, more) = match version {
        FmiVersion::Two => (
            "fmi2GetDirectionalDerivative",
            "fmi2GetRealOutputDerivatives",
            format!(
                "An importer that also gives the input's time derivatives \
                 (fmi2SetRealInputDerivatives, orders 1 to 3) has <code>{input}</code> continued \
                 from the communication point instead, and turning values inside the step are \
                 found. <code>iwan export --fmi 3</code> makes the archive of FMI 3.0."
            ),
        ),
        FmiVersion::Three => (
            "fmi3GetDirectionalDerivative",
            "fmi3GetOutputDerivatives",
            "The adjoint product is there too (fmi3GetAdjointDerivative). No event mode, no early \
             return, no intermediate update: an importer need not be ready for them. The terminal \
             <code>joint</code> holds displacement and force."
                .to_owned(),
        ),
    };
    let _ = writeln!(
        page,
        "<p>Derivatives of the outputs: with respect to <code>{input}</code> the tangent of the \
         last step, rates and creep of that step included ({directional}), and of order 1 in time \
         at its end ({outputs}). {more}</p>"
    );
}
