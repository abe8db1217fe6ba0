//! How to use the unit in importers.

use crate::joint::Drive;
use crate::pack::Experiment;
use crate::saved::Provenance;
use std::fmt::Write as _;

/// The section.
pub fn section(page: &mut String, drive: Drive, provenance: &Provenance) {
    let (input, output) = match drive {
        Drive::Force => ("force", "displacement"),
        Drive::Displacement => ("displacement", "force"),
    };
    let Experiment {
        stop_time,
        step_size,
    } = Experiment::of(provenance);
    let _ = writeln!(
        page,
        "<h2>Use</h2>\n<p>Input <code>{input}</code>, answer <code>{output}</code>. The value of \
         <code>{input}</code> that is set before fmi2DoStep is its value at the <em>end</em> of \
         the step. An importer that also gives the input's time derivatives \
         (fmi2SetRealInputDerivatives, orders 1 to 3) has it continued from the communication \
         point instead, and turning values inside the step are found.</p>"
    );
    let _ = writeln!(
        page,
        "<p>Step: any length. What counts is that the turning values of the input fall on \
         communication points: a sine seen 20 times per cycle dissipates 1.3 % too little, seen \
         100 times 0.05 %. <code>iwan check JOINT.fmu RECORD</code> says it for a record.</p>"
    );
    let _ = writeln!(
        page,
        "<ul>\n\
         <li>fmpy: <code>fmpy simulate joint.fmu --interface-type CoSimulation --input-file \
         load.csv --stop-time {stop_time} --step-size {step_size} --output-file out.csv</code>; \
         the column of the load is <code>{input}</code></li>\n\
         <li>Simulink: block <em>FMU</em>, Mode <em>Co-Simulation</em>, communication step \
         {step_size} s; parameters are in the block's dialog</li>\n\
         <li>Modelica tools: import the FMU, connect <code>{input}</code> to the output of a \
         block; a driven joint between two flanges takes <code>--drive displacement</code></li>\n\
         <li>Rigs: one instance per joint; a step has no file access and no lock; parameters \
         before the start</li>\n</ul>\n\
         <p>The complete state can be saved, put back, serialized and continued in another \
         process; any number of instances run in one.</p>"
    );
}
