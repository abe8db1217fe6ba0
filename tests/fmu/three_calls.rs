//! The functions of FMI 3.0.

use super::call_table::{Hosted, Row, Turn, rows, state_functions};
use super::host::{DISPLACEMENT, FORCE, Resources};
use super::three_host::Three;
use iwan::fmu::*;
use iwan::joint::Drive;
use iwan::variables::TIME_REFERENCE;
use std::ptr::{null, null_mut};

impl Hosted for Three {
    #[rustfmt::skip]
    fn table() -> Vec<Row<Three>> {
        let mut table = rows! {
            fmi3SetDebugLogging "INST" (plain 0, count 1, read &c"logEvents".as_ptr());
            fmi3EnterInitializationMode "I" (plain 0, plain 0.0, plain 0.0, plain 0, plain 0.0);
            fmi3ExitInitializationMode "N" ();
            fmi3Terminate "S" ();
            fmi3Reset "INST" ();
            fmi3GetFloat64 "INST" (read &DISPLACEMENT, plain 1, write &mut 0.0, plain 1);
            fmi3SetFloat64 "INS" (read &FORCE, plain 1, read &0.0, plain 1);
            fmi3GetDirectionalDerivative "NST" (read &DISPLACEMENT, plain 1, read &FORCE, plain 1, read &1.0, plain 1, write &mut 0.0, plain 1);
            fmi3GetAdjointDerivative "NST" (read &DISPLACEMENT, plain 1, read &FORCE, plain 1, read &1.0, plain 1, write &mut 0.0, plain 1);
            fmi3GetOutputDerivatives "ST" (read &DISPLACEMENT, plain 1, read &1, write &mut 0.0, plain 1);
            // Of types that no variable has.
            fmi3GetFloat32 "INST" (read &0, count 1, write &mut 0.0, count 1);
            fmi3GetInt8 "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetUInt8 "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetInt16 "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetUInt16 "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetInt32 "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetUInt32 "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetInt64 "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetUInt64 "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetBoolean "INST" (read &0, count 1, write &mut 0, count 1);
            fmi3GetString "INST" (read &0, count 1, write &mut null(), count 1);
            fmi3GetBinary "INST" (read &0, count 1, write &mut 0, write &mut null(), count 1);
            fmi3GetClock "INST" (read &0, count 1, write &mut 0);
            fmi3GetIntervalDecimal "NST" (read &0, count 1, write &mut 0.0, write &mut 0);
            fmi3GetIntervalFraction "NST" (read &0, count 1, write &mut 0, write &mut 0, write &mut 0);
            fmi3GetShiftDecimal "NST" (read &0, count 1, write &mut 0.0);
            fmi3GetShiftFraction "NST" (read &0, count 1, write &mut 0, write &mut 0);
            fmi3SetFloat32 "INS" (read &0, count 1, read &0.0, count 1);
            fmi3SetInt8 "INS" (read &0, count 1, read &0, count 1);
            fmi3SetUInt8 "INS" (read &0, count 1, read &0, count 1);
            fmi3SetInt16 "INS" (read &0, count 1, read &0, count 1);
            fmi3SetUInt16 "INS" (read &0, count 1, read &0, count 1);
            fmi3SetInt32 "INS" (read &0, count 1, read &0, count 1);
            fmi3SetUInt32 "INS" (read &0, count 1, read &0, count 1);
            fmi3SetInt64 "INS" (read &0, count 1, read &0, count 1);
            fmi3SetUInt64 "INS" (read &0, count 1, read &0, count 1);
            fmi3SetBoolean "INS" (read &0, count 1, read &0, count 1);
            fmi3SetString "INS" (read &0, count 1, read &c"".as_ptr(), count 1);
            fmi3SetBinary "INS" (read &0, count 1, read &0, read &null(), count 1);
            fmi3SetClock "INS" (read &0, count 1, read &0);
            fmi3SetIntervalDecimal "INS" (read &0, count 1, read &0.0);
            fmi3SetIntervalFraction "INS" (read &0, count 1, read &0, read &0);
            fmi3SetShiftDecimal "INS" (read &0, count 1, read &0.0);
            fmi3SetShiftFraction "INS" (read &0, count 1, read &0, read &0);
            // Of what modelDescription.xml does not offer.
            fmi3EnterEventMode "" ();
            fmi3EnterStepMode "" ();
            fmi3EvaluateDiscreteStates "" ();
            fmi3UpdateDiscreteStates "" (write &mut 0, write &mut 0, write &mut 0, write &mut 0, write &mut 0, write &mut 0.0);
            fmi3EnterConfigurationMode "" ();
            fmi3ExitConfigurationMode "" ();
            fmi3GetNumberOfVariableDependencies "" (plain DISPLACEMENT, write &mut 0);
            fmi3GetVariableDependencies "" (plain DISPLACEMENT, write &mut 0, write &mut 0, write &mut 0, write &mut 0, plain 1);
            fmi3EnterContinuousTimeMode "" ();
            fmi3CompletedIntegratorStep "" (plain 0, write &mut 0, write &mut 0);
            fmi3SetTime "" (plain 0.0);
            fmi3SetContinuousStates "" (read &0.0, plain 1);
            fmi3GetContinuousStateDerivatives "" (write &mut 0.0, plain 1);
            fmi3GetEventIndicators "" (write &mut 0.0, plain 1);
            fmi3GetContinuousStates "" (write &mut 0.0, plain 1);
            fmi3GetNominalsOfContinuousStates "" (write &mut 0.0, plain 1);
            fmi3GetNumberOfEventIndicators "" (write &mut 0);
            fmi3GetNumberOfContinuousStates "" (write &mut 0);
            fmi3ActivateModelPartition "" (plain 0, plain 0.0);
        };
        table.push(Row { name: "fmi3DoStep", allowed: "S", call: step_on });
        table.push(STATES);
        table
    }

    const BESIDE: &'static [&'static str] = BESIDE;

    fn instantiated(resources: &Resources) -> Three {
        Three::new(resources, Drive::Force)
    }

    fn told(&self) -> Option<String> {
        self.last_message()
    }

    fn bytes(&self) -> Vec<u8> {
        bytes(self)
    }

    fn restore(&self, bytes: &[u8]) {
        restore(self, bytes);
    }
}

/// A step from wherever the instance stands.
fn step_on(three: &Three, turn: &Turn) -> Status {
    let (mut now, mut time, [mut event, mut end, mut early]) = (0.0, 0.0, [0; 3]);
    unsafe {
        // Refused only where no step would be allowed either.
        let _ = fmi3GetFloat64(three.handle, &TIME_REFERENCE, 1, &mut now, 1);
        fmi3DoStep(
            turn.handle(three.handle),
            now,
            1e-3,
            1,
            turn.write(&mut event),
            turn.write(&mut end),
            turn.write(&mut early),
            turn.write(&mut time),
        )
    }
}

state_functions!(
    Three: fmi3GetFMUState fmi3SerializedFMUStateSize fmi3SerializeFMUState
    fmi3DeserializeFMUState fmi3SetFMUState fmi3FreeFMUState
);
