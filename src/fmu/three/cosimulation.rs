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
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        scalars("nSeed", known_count, seed_count)?;
        scalars("nSensitivity", unknown_count, sensitivity_count)?;
        let unknowns = pointers::slice("unknowns", unknowns, unknown_count)?;
        instance.check_knowns(pointers::slice("knowns", knowns, known_count)?)?;
        let seed: f64 = pointers::slice("seed", seed, seed_count)?.iter().sum();
        let places = Destination::new("sensitivity", sensitivity, sensitivity_count)?;
        instance.slopes(unknowns, |place, slope| {
            places.write_at(place, slope * seed)
        })
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::GET_DIRECTIONAL_DERIVATIVE_3, body) }
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
    // SAFETY: arrays as the standard asks.
    let body = |instance: &mut Instance| unsafe {
        scalars("nSeed", unknown_count, seed_count)?;
        scalars("nSensitivity", known_count, sensitivity_count)?;
        let unknowns = pointers::slice("unknowns", unknowns, unknown_count)?;
        instance.check_knowns(pointers::slice("knowns", knowns, known_count)?)?;
        let seed = pointers::slice("seed", seed, seed_count)?;
        let places = Destination::new("sensitivity", sensitivity, sensitivity_count)?;
        let mut sum = 0.0;
        instance.slopes(unknowns, |place, slope| sum += slope * seed[place])?;
        (0..known_count).for_each(|place| places.write_at(place, sum));
        Ok(())
    };
    // SAFETY: handle as the standard asks.
    unsafe { call(instance, calls::GET_ADJOINT_DERIVATIVE_3, body) }
}
