//! Steps and derivatives.

use super::values::scalars;
use crate::fmu::c_types::{Boolean3, Component, Status};
use crate::fmu::calls;
use crate::fmu::entry::call;
use crate::fmu::instance::Instance;
use crate::fmu::pointers::{self, Destination};
use libc::size_t;

/// Moves the joint over one communication step. The input, as set before, is the input at the end
/// of the step. No event is ever raised, no end of the simulation asked for, and no step returns
/// early.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, the four answers may be written.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3DoStep(
    instance: Component,
    point: f64,
    size: f64,
    _no_set_state_prior: Boolean3,
    event_handling_needed: *mut Boolean3,
    terminate_simulation: *mut Boolean3,
    early_return: *mut Boolean3,
    last_successful_time: *mut f64,
) -> Status {
    // SAFETY: places as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        let event = Destination::new("eventHandlingNeeded", event_handling_needed, 1)?;
        let terminate = Destination::new("terminateSimulation", terminate_simulation, 1)?;
        let early = Destination::new("earlyReturn", early_return, 1)?;
        let time = Destination::new("lastSuccessfulTime", last_successful_time, 1)?;
        instance.step(point, size)?;
        for answer in [event, terminate, early] {
            answer.write_at(0, 0);
        }
        time.write_at(0, instance.motion.time);
        Ok(())
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::DO_STEP_3, body) }
}

/// First time derivatives of outputs at the end of the last step.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, the counted items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetOutputDerivatives(
    instance: Component,
    references: *const u32,
    count: size_t,
    orders: *const i32,
    values: *mut f64,
    value_count: size_t,
) -> Status {
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        scalars("nValues", count, value_count)?;
        let references = pointers::slice("valueReferences", references, count)?;
        let orders = pointers::slice("orders", orders, count)?;
        let places = Destination::new("values", values, count)?;
        instance.output_derivatives(references, orders, |place, rate| {
            places.write_at(place, rate)
        })
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::GET_OUTPUT_DERIVATIVES_3, body) }
}

/// Derivatives of outputs with respect to the input, times its seed, as
/// [`fmi2GetDirectionalDerivative`](crate::fmu::fmi2GetDirectionalDerivative).
///
/// # Safety
/// As the FMI standard asks: a handle of this library, the counted items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetDirectionalDerivative(
    instance: Component,
    unknowns: *const u32,
    unknown_count: size_t,
    knowns: *const u32,
    known_count: size_t,
    seed: *const f64,
    seed_count: size_t,
    sensitivity: *mut f64,
    sensitivity_count: size_t,
) -> Status {
    let variables = [(unknowns, unknown_count), (knowns, known_count)];
    let (seed, answers) = ((seed, seed_count), (sensitivity, sensitivity_count));
    // SAFETY: handle and arrays as the standard asks.
    unsafe { Product::Directional.write(instance, variables, seed, answers) }
}

/// The transposed product: seeds of outputs, summed with their derivatives, per known.
///
/// # Safety
/// As the FMI standard asks: a handle of this library, the counted items in each array.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn fmi3GetAdjointDerivative(
    instance: Component,
    unknowns: *const u32,
    unknown_count: size_t,
    knowns: *const u32,
    known_count: size_t,
    seed: *const f64,
    seed_count: size_t,
    sensitivity: *mut f64,
    sensitivity_count: size_t,
) -> Status {
    let variables = [(unknowns, unknown_count), (knowns, known_count)];
    let (seed, answers) = ((seed, seed_count), (sensitivity, sensitivity_count));
    // SAFETY: handle and arrays as the standard asks.
    unsafe { Product::Adjoint.write(instance, variables, seed, answers) }
}

/// Which product of derivatives and seed is asked for.
#[derive(Clone, Copy)]
enum Product {
    /// A seed per known, an answer per unknown.
    Directional,
    /// A seed per unknown, an answer per known.
    Adjoint,
}

impl Product {
    /// Either product over the same arrays, under the same checks. There is one input: where it is
    /// named twice its seeds add up, and each naming gets the same answer.
    ///
    /// # Safety
    /// As the FMI standard asks: a handle of this library, the counted items in each array.
    unsafe fn write(
        self,
        instance: Component,
        [unknowns, knowns]: [(*const u32, size_t); 2],
        seed: (*const f64, size_t),
        answers: (*mut f64, size_t),
    ) -> Status {
        let (function, seeded, answered) = match self {
            Product::Directional => (calls::GET_DIRECTIONAL_DERIVATIVE_3, knowns.1, unknowns.1),
            Product::Adjoint => (calls::GET_ADJOINT_DERIVATIVE_3, unknowns.1, knowns.1),
        };
        // SAFETY: arrays by this function's contract.
        let body = |instance: &mut Instance| unsafe {
            scalars("nSeed", seeded, seed.1)?;
            scalars("nSensitivity", answered, answers.1)?;
            let unknowns = pointers::slice("unknowns", unknowns.0, unknowns.1)?;
            instance.check_knowns(pointers::slice("knowns", knowns.0, knowns.1)?)?;
            let seed = pointers::slice("seed", seed.0, seed.1)?;
            Instance::check_seeds("seed", seed)?;
            let places = Destination::new("sensitivity", answers.0, answers.1)?;
            match self {
                Product::Directional => {
                    let seed: f64 = seed.iter().sum();
                    instance.slopes(unknowns, |place, slope| {
                        places.write_at(place, slope * seed)
                    })
                }
                Product::Adjoint => {
                    let mut sum = 0.0;
                    instance.slopes(unknowns, |place, slope| sum += slope * seed[place])?;
                    (0..answered).for_each(|place| places.write_at(place, sum));
                    Ok(())
                }
            }
        };
        // SAFETY: handle by this function's contract.
        unsafe { call(instance, function, body) }
    }
}
