//! Call order: for every function the modes in which it may be called.

/// Where an instance stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Mode {
    /// After fmi2Instantiate or fmi2Reset.
    Instantiated = 0,
    /// Between fmi2EnterInitializationMode and fmi2ExitInitializationMode.
    Initialization = 1,
    /// Ready for fmi2DoStep.
    Stepping = 2,
    /// After fmi2Terminate.
    Terminated = 3,
    /// After a defect in this library: only reset, a saved state or freeing help.
    Broken = 4,
}

impl Mode {
    /// In words, for messages.
    pub fn name(self) -> &'static str {
        match self {
            Mode::Instantiated => "instantiated",
            Mode::Initialization => "initialization",
            Mode::Stepping => "stepping",
            Mode::Terminated => "terminated",
            Mode::Broken => "broken",
        }
    }

    /// Mode of a saved state.
    pub fn from_number(number: u8) -> Option<Mode> {
        [
            Mode::Instantiated,
            Mode::Initialization,
            Mode::Stepping,
            Mode::Terminated,
        ]
        .into_iter()
        .find(|mode| *mode as u8 == number)
    }
}

use Mode::{Broken as B, Initialization as N, Instantiated as I, Stepping as S, Terminated as T};

/// One function and the modes in which it may be called.
#[derive(Debug)]
pub struct Call {
    /// Name of the C function.
    pub name: &'static str,
    allowed: &'static [Mode],
}

impl Call {
    /// True where the function may be called in this mode.
    pub fn allowed_in(&self, mode: Mode) -> bool {
        self.allowed.contains(&mode)
    }

    /// The allowed modes in words.
    pub fn expected(&self) -> String {
        if self.allowed.is_empty() {
            return "no mode at all: steps are synchronous".to_owned();
        }
        let names: Vec<_> = self.allowed.iter().map(|mode| mode.name()).collect();
        names.join(" or ")
    }
}

/// Writes one constant per row, and for tests a list of them all.
macro_rules! calls {
    ($list:ident: $($constant:ident $name:literal [$($mode:ident)*];)*) => {
        $(#[doc = $name] pub const $constant: Call = Call { name: $name, allowed: &[$($mode),*] };)*
        #[cfg(test)]
        pub const $list: &[Call] = &[$($constant),*];
    };
}

// FMI 2.0.4, section 4.2.4, table of allowed calls. I instantiated, N initialization, S stepping,
// T terminated, B broken. fmi2FreeInstance is allowed in all of them and answers nothing.
calls! {
    ALL_OF_FMI_2:
    SET_DEBUG_LOGGING "fmi2SetDebugLogging" [I N S T B];
    SETUP_EXPERIMENT "fmi2SetupExperiment" [I];
    ENTER_INITIALIZATION_MODE "fmi2EnterInitializationMode" [I];
    EXIT_INITIALIZATION_MODE "fmi2ExitInitializationMode" [N];
    TERMINATE "fmi2Terminate" [S];
    RESET "fmi2Reset" [I N S T B];
    GET_REAL "fmi2GetReal" [N S T];
    GET_INTEGER "fmi2GetInteger" [N S T];
    GET_BOOLEAN "fmi2GetBoolean" [N S T];
    GET_STRING "fmi2GetString" [N S T];
    SET_REAL "fmi2SetReal" [I N S];
    SET_INTEGER "fmi2SetInteger" [I N S];
    SET_BOOLEAN "fmi2SetBoolean" [I N S];
    SET_STRING "fmi2SetString" [I N S];
    GET_FMU_STATE "fmi2GetFMUstate" [I N S T];
    SET_FMU_STATE "fmi2SetFMUstate" [I N S T B];
    FREE_FMU_STATE "fmi2FreeFMUstate" [I N S T B];
    SERIALIZED_FMU_STATE_SIZE "fmi2SerializedFMUstateSize" [I N S T B];
    SERIALIZE_FMU_STATE "fmi2SerializeFMUstate" [I N S T B];
    DESERIALIZE_FMU_STATE "fmi2DeSerializeFMUstate" [I N S T B];
    GET_DIRECTIONAL_DERIVATIVE "fmi2GetDirectionalDerivative" [N S T];
    SET_REAL_INPUT_DERIVATIVES "fmi2SetRealInputDerivatives" [I N S];
    GET_REAL_OUTPUT_DERIVATIVES "fmi2GetRealOutputDerivatives" [S T];
    DO_STEP "fmi2DoStep" [S];
    CANCEL_STEP "fmi2CancelStep" [];
    GET_STATUS "fmi2GetStatus" [S T];
    GET_REAL_STATUS "fmi2GetRealStatus" [S T];
    GET_INTEGER_STATUS "fmi2GetIntegerStatus" [S T];
    GET_BOOLEAN_STATUS "fmi2GetBooleanStatus" [S T];
    GET_STRING_STATUS "fmi2GetStringStatus" [S T];
}

// FMI 3.0, sections 2.3 and 4.2, states of co-simulation without event mode: Step Mode is
// `stepping`. Unlike FMI 2.0 it lets start values be read before initialization.
calls! {
    ALL_OF_FMI_3:
    SET_DEBUG_LOGGING_3 "fmi3SetDebugLogging" [I N S T B];
    ENTER_INITIALIZATION_MODE_3 "fmi3EnterInitializationMode" [I];
    EXIT_INITIALIZATION_MODE_3 "fmi3ExitInitializationMode" [N];
    TERMINATE_3 "fmi3Terminate" [S];
    RESET_3 "fmi3Reset" [I N S T B];
    GET_FLOAT64_3 "fmi3GetFloat64" [I N S T];
    SET_FLOAT64_3 "fmi3SetFloat64" [I N S];
    GET_FMU_STATE_3 "fmi3GetFMUState" [I N S T];
    SET_FMU_STATE_3 "fmi3SetFMUState" [I N S T B];
    FREE_FMU_STATE_3 "fmi3FreeFMUState" [I N S T B];
    SERIALIZED_FMU_STATE_SIZE_3 "fmi3SerializedFMUStateSize" [I N S T B];
    SERIALIZE_FMU_STATE_3 "fmi3SerializeFMUState" [I N S T B];
    DESERIALIZE_FMU_STATE_3 "fmi3DeserializeFMUState" [I N S T B];
    GET_DIRECTIONAL_DERIVATIVE_3 "fmi3GetDirectionalDerivative" [N S T];
    GET_ADJOINT_DERIVATIVE_3 "fmi3GetAdjointDerivative" [N S T];
    GET_OUTPUT_DERIVATIVES_3 "fmi3GetOutputDerivatives" [S T];
    DO_STEP_3 "fmi3DoStep" [S];
}

/// A function that reads variables of a type that none has.
pub const fn reading(name: &'static str) -> Call {
    Call {
        name,
        allowed: &[I, N, S, T],
    }
}

/// A function that reads intervals or shifts of clocks, of which there are none.
pub const fn timing(name: &'static str) -> Call {
    Call {
        name,
        allowed: &[N, S, T],
    }
}

/// A function that sets variables of a type that none has.
pub const fn setting(name: &'static str) -> Call {
    Call {
        name,
        allowed: &[I, N, S],
    }
}

/// A function that is refused for another reason than the mode.
pub const fn anywhere(name: &'static str) -> Call {
    Call {
        name,
        allowed: &[I, N, S, T, B],
    }
}
