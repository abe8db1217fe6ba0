//! References, parameters, starts.

use super::host::*;
use iwan::fmu::*;
use iwan::joint::{Drive, Simulation};
use iwan::variables::{Causality, Variables};
use std::ptr;

#[test]
fn unknown_references_and_null_arrays_are_refused() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let mut values = [7.0, 7.0];
    let references = [DISPLACEMENT, 99];
    let status = unsafe { fmi2GetReal(unit.handle, references.as_ptr(), 2, values.as_mut_ptr()) };
    assert!(unit.error(status).contains("came 99"));
    assert_eq!(values, [7.0, 7.0], "outputs are written only on success");
    let status = unsafe { fmi2GetReal(unit.handle, ptr::null(), 1, values.as_mut_ptr()) };
    assert!(
        unit.error(status)
            .contains("vr: expected a pointer, came NULL")
    );
    let status = unsafe { fmi2GetReal(unit.handle, &FORCE, 1, ptr::null_mut()) };
    assert!(
        unit.error(status)
            .contains("value: expected a pointer, came NULL")
    );
    let status = unsafe { fmi2SetReal(unit.handle, &FORCE, 1, ptr::null()) };
    assert!(unit.error(status).contains("came NULL"));
    unit.ok(unsafe { fmi2GetReal(unit.handle, ptr::null(), 0, ptr::null_mut()) });
    unit.ok(unsafe { fmi2SetReal(unit.handle, ptr::null(), 0, ptr::null()) });
}

/// Some hosts read Integer variables with fmi2GetReal and the other way round.
#[test]
fn variables_of_other_types_are_refused() {
    let resources = Resources::new(BOLT);
    let unit = Unit::stepping(&resources, Drive::Force);
    let handle = unit.handle;
    let told = |status| unit.error(status);
    unsafe {
        let mut number = 7;
        assert!(
            told(fmi2GetInteger(handle, &FORCE, 1, &mut number))
                .contains("a variable of type Integer, came 0")
        );
        assert!(
            told(fmi2GetBoolean(handle, &FORCE, 1, &mut number))
                .contains("a variable of type Boolean, came 0")
        );
        assert!(
            told(fmi2GetString(handle, &FORCE, 1, &mut ptr::null()))
                .contains("a variable of type String, came 0")
        );
        assert!(
            told(fmi2SetInteger(handle, &FORCE, 1, &1))
                .contains("a variable of type Integer, came 0")
        );
        assert!(
            told(fmi2SetBoolean(handle, &FORCE, 1, &1))
                .contains("a variable of type Boolean, came 0")
        );
        assert!(
            told(fmi2SetString(handle, &FORCE, 1, &c"".as_ptr()))
                .contains("a variable of type String, came 0")
        );
        assert_eq!(number, 7);
    }
}

#[test]
fn parameters_start_at_the_joints_values_and_are_fixed_after_initialization() {
    let resources = Resources::new(BOLT_WITH_CAUSES);
    let unit = Unit::initializing(&resources, Drive::Force);
    let joint = resources.joint();
    for variable in &Variables::of(&joint, Drive::Force).unwrap().parameters {
        assert_eq!(
            Some(unit.get(&[variable.reference])[0]),
            variable.start(&joint)
        );
    }
    unit.ok(unit.set(SLIP_FORCE, 900.0));
    unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
    assert!(
        unit.error(unit.set(SLIP_FORCE, 800.0))
            .contains("it is fixed afterwards")
    );
    assert_eq!(unit.get(&[SLIP_FORCE]), [900.0]);
}

/// Set before fmi2SetupExperiment or in Initialization Mode, a parameter makes the joint that
/// joint.json would have made of it.
#[test]
fn a_parameter_set_by_the_host_is_the_joints() {
    let resources = Resources::new(BOLT_WITH_CAUSES);
    let changed = BOLT_WITH_CAUSES
        .replace("4e7", "5e7")
        .replace("1000.0", "1200.0");
    let changed = changed.replace("1e-5", "3e-6");
    let joint = iwan::saved::read(&changed, "joint.json").unwrap().joint;
    let mut simulation = Simulation::new(&joint, Drive::Force).unwrap();
    simulation.step(0.0, 0.0).unwrap();
    let early = Unit::instantiated(&resources, Drive::Force);
    let late = Unit::initializing(&resources, Drive::Force);
    for unit in [&early, &late] {
        unit.ok(unit.set(SERIES_STIFFNESS, 5e7));
        unit.ok(unit.set(SLIP_FORCE, 1200.0));
        unit.ok(unit.set(reference(&resources, "pinning.gap_positive"), 3e-6));
    }
    early.ok(unsafe { fmi2SetupExperiment(early.handle, FALSE, 0.0, 0.0, FALSE, 0.0) });
    early.ok(unsafe { fmi2EnterInitializationMode(early.handle) });
    for unit in [&early, &late] {
        unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
    }
    let mut before = 0.0;
    for (t, force) in history().skip(1) {
        let expected = simulation.step(t, force).unwrap();
        for unit in [&early, &late] {
            assert_eq!(
                unit.drive(FORCE, force, before, t - before)[0],
                expected.displacement
            );
        }
        before = t;
    }
}

#[test]
fn values_out_of_bounds_are_refused_all_or_none() {
    let resources = Resources::new(BOLT);
    let unit = Unit::initializing(&resources, Drive::Force);
    let joint = resources.joint();
    for variable in &Variables::of(&joint, Drive::Force).unwrap().parameters {
        let start = variable.start(&joint).unwrap();
        for wrong in [
            f64::NAN,
            f64::INFINITY,
            -f64::INFINITY,
            variable.lower - 1.0,
        ] {
            let both = [FORCE, variable.reference];
            let values = [5.0, wrong];
            let status = unsafe { fmi2SetReal(unit.handle, both.as_ptr(), 2, values.as_ptr()) };
            assert!(unit.error(status).contains(&variable.name));
        }
        assert_eq!(unit.get(&[FORCE, variable.reference]), [0.0, start]);
    }
    assert!(unit.error(unit.set(FORCE, f64::NAN)).contains("`force`"));
    assert!(
        unit.error(unit.set(DISPLACEMENT, 0.0))
            .contains("output `displacement`")
    );
}

/// Start values that are fine one by one and not together: told when the joint is made of them,
/// and mended by setting either.
#[test]
fn a_start_that_cannot_be_is_told_at_the_end_of_initialization() {
    let resources = Resources::new(BOLT);
    let unit = Unit::initializing(&resources, Drive::Force);
    unit.ok(unit.set(FORCE, 2000.0));
    let told = unit.error(unsafe { fmi2ExitInitializationMode(unit.handle) });
    assert!(told.starts_with("fmi2ExitInitializationMode: "), "{told}");
    assert!(told.contains("full slip at 1000 N"), "{told}");
    unit.ok(unit.set(SLIP_FORCE, 3000.0));
    unit.ok(unsafe { fmi2ExitInitializationMode(unit.handle) });
}

#[test]
fn the_input_acts_in_initialization_mode_and_the_drive_swaps_it() {
    let resources = Resources::new(BOLT);
    let joint = resources.joint();
    let unit = Unit::initializing(&resources, Drive::Force);
    unit.ok(unit.set(FORCE, 400.0));
    let first = unit.get(&[DISPLACEMENT])[0];
    unit.ok(unit.set(FORCE, 300.0));
    let expected = Simulation::new(&joint, Drive::Force)
        .unwrap()
        .step(0.0, 300.0)
        .unwrap();
    // Virgin under 300 N: the 400 N of before are forgotten.
    assert_eq!(
        unit.get(&[FORCE, DISPLACEMENT]),
        [300.0, expected.displacement]
    );
    assert_ne!(first, expected.displacement);

    let swapped = Unit::initializing(&resources, Drive::Displacement);
    swapped.ok(swapped.set(DISPLACEMENT, 1e-5));
    let mut simulation = Simulation::new(&joint, Drive::Displacement).unwrap();
    let expected = simulation.step(0.0, 1e-5).unwrap();
    assert_eq!(swapped.get(&[FORCE, DISPLACEMENT]), [expected.force, 1e-5]);
    assert!(
        swapped
            .error(swapped.set(FORCE, 0.0))
            .contains("output `force`")
    );
}

/// Same references in every export: the numbers of the tables, in both drives and with causes.
#[test]
fn references_mean_the_same_in_every_export() {
    let mut seen = std::collections::BTreeMap::new();
    for json in [
        BOLT,
        BOLT_WITH_CAUSES,
        include_str!("../../examples/table1_case1.json"),
    ] {
        let joint = iwan::saved::read(json, "joint.json").unwrap().joint;
        for drive in [Drive::Force, Drive::Displacement] {
            let variables = Variables::of(&joint, drive).unwrap();
            let inputs = variables.iter().filter(|v| v.causality == Causality::Input);
            assert_eq!(inputs.count(), 1);
            for variable in variables.iter() {
                let other = seen.insert(variable.reference, variable.name.clone());
                assert!(
                    other.is_none_or(|other| other == variable.name),
                    "{variable:?}"
                );
            }
        }
    }
    for (reference, name) in [(0, "force"), (1, "displacement"), (2, "dissipation")] {
        assert_eq!(seen[&reference], name);
    }
    assert_eq!(seen[&1032], "pinning.stiffness");
}

/// Whatever the catalogue and the densities hold has its place in the tables.
#[test]
fn every_cause_and_every_family_can_be_exported() {
    use iwan::joint::{Acting, Density, PowerLawTable, Sliders};
    let families = [
        Density::from_values("power_law", &[4.0, 0.0, 0.5, 1e-3, 1000.0]).unwrap(),
        Density::from_values("four_parameter", &[1000.0, 1e7, -0.3, 0.2]).unwrap(),
        Density::Sliders(Sliders::new(vec![1e6], vec![1e-5], 10.0).unwrap()),
        Density::PowerLawTable(
            PowerLawTable::new(4.0, 0.0, 0.5, 1000.0, vec![1e-3, 2e-3], vec![1.0, 1.0]).unwrap(),
        ),
    ];
    let joint_causes = iwan::causes::CATALOGUE
        .iter()
        .filter(|c| !c.place().is_measurement());
    let middle = |p: &iwan::joint::Parameter| p.lower.max(p.upper.min(1.0));
    let effects: Vec<_> = joint_causes
        .map(|cause| Acting {
            effect: cause.effect(),
            values: cause.parameters().iter().map(middle).collect(),
        })
        .collect();
    assert!(!effects.is_empty());
    let glossaries: usize = effects.iter().map(|acting| acting.values.len()).sum();
    for density in families {
        let own = density.parameters().len();
        let mut joint = Resources::new(BOLT).joint();
        (joint.density, joint.effects) = (density, effects.clone());
        let variables = Variables::of(&joint, Drive::Force).unwrap();
        assert_eq!(variables.parameters.len(), 1 + own + glossaries);
        let values = variables.values(&joint);
        assert_eq!(variables.apply(&joint, &values).unwrap(), joint);
    }
}
