//! The functions of FMI 2.0.

use super::call_table::{Hosted, Row, Turn, rows, state_functions};
use super::host::{DISPLACEMENT, FORCE, Resources, Unit};
use iwan::fmu::*;
use iwan::joint::Drive;
use std::ptr::{null, null_mut};

impl Hosted for Unit {
    #[rustfmt::skip]
    fn table() -> Vec<Row<Unit>> {
        let mut table = rows! {
            fmi2SetDebugLogging "INST" (plain FALSE, count 1, read &c"logEvents".as_ptr());
            fmi2SetupExperiment "I" (plain FALSE, plain 0.0, plain 0.0, plain FALSE, plain 0.0);
            fmi2EnterInitializationMode "I" ();
            fmi2ExitInitializationMode "N" ();
            fmi2Terminate "S" ();
            fmi2Reset "INST" ();
            fmi2GetReal "NST" (read &DISPLACEMENT, plain 1, write &mut 0.0);
            fmi2GetInteger "NST" (read &0, count 1, write &mut 0);
            fmi2GetBoolean "NST" (read &0, count 1, write &mut 0);
            fmi2GetString "NST" (read &0, count 1, write &mut null());
            fmi2SetReal "INS" (read &FORCE, plain 1, read &0.0);
            fmi2SetInteger "INS" (read &0, count 1, read &0);
            fmi2SetBoolean "INS" (read &0, count 1, read &0);
            fmi2SetString "INS" (read &0, count 1, read &c"".as_ptr());
            fmi2SetRealInputDerivatives "INS" (read &FORCE, plain 1, read &1, read &0.0);
            fmi2GetRealOutputDerivatives "ST" (read &DISPLACEMENT, plain 1, read &1, write &mut 0.0);
            fmi2GetDirectionalDerivative "NST" (read &DISPLACEMENT, plain 1, read &FORCE, plain 1, read &1.0, write &mut 0.0);
            fmi2CancelStep "" ();
            fmi2GetStatus "ST" (plain 0, write &mut Status::Error);
            fmi2GetRealStatus "ST" (plain 2, write &mut 0.0);
            fmi2GetIntegerStatus "" (plain 0, write &mut 0);
            fmi2GetBooleanStatus "ST" (plain 3, write &mut 7);
            fmi2GetStringStatus "ST" (plain 1, write &mut null());
        };
        table.push(Row { name: "fmi2DoStep", allowed: "S", call: step_on });
        table.push(STATES);
        table
    }

    const BESIDE: &'static [&'static str] = BESIDE;

    fn instantiated(resources: &Resources) -> Unit {
        Unit::instantiated(resources, Drive::Force)
    }

    fn told(&self) -> Option<String> {
        self.log().last().map(|message| message.text.clone())
    }

    fn bytes(&self) -> Vec<u8> {
        bytes(self)
    }

    fn restore(&self, bytes: &[u8]) {
        restore(self, bytes);
    }
}

/// A step from wherever the instance stands.
fn step_on(unit: &Unit, turn: &Turn) -> Status {
    let mut time = 0.0;
    // Refused where no step would be allowed either.
    let _ = unsafe { fmi2GetRealStatus(unit.handle, 2, &mut time) };
    unsafe { fmi2DoStep(turn.handle(unit.handle), time, 1e-3, TRUE) }
}

state_functions!(
    Unit: fmi2GetFMUstate fmi2SerializedFMUstateSize fmi2SerializeFMUstate
    fmi2DeSerializeFMUstate fmi2SetFMUstate fmi2FreeFMUstate
);
