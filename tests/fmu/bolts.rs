//! The bolt with causes of the joint, each at the largest of its starting values.

use super::host::{BOLT, Resources};
use iwan::causes::{CATALOGUE, Kind, Scale};

/// Name of each joint cause, and what joint.json says of it.
fn causes() -> Vec<(&'static str, String)> {
    let scale = Scale {
        force: 600.0,
        displacement: 7e-5,
        velocity: 8e-3,
        stiffness: 1.1e7,
        dissipation: 0.1,
        lengths: vec![0.4],
        jumps: vec![],
        path: 1e-3,
        period: 0.02,
        first_turns: (0.0, 0.0),
        slowest: 0.02,
        step: 1e-3,
        finest: 1e-3,
        judges_force: true,
        ringing: vec![],
        mains: vec![],
    };
    let joint_causes = CATALOGUE.iter().filter(|cause| cause.kind() == Kind::Joint);
    joint_causes
        .map(|cause| {
            let values = cause.starts(&scale).pop().unwrap();
            let named = cause.parameters().iter().zip(values);
            let named: Vec<String> = named
                .map(|(parameter, value)| format!("\"{}\": {value:e}", parameter.name))
                .collect();
            let (name, named) = (cause.name(), named.join(", "));
            let acting = format!(r#"{{"name": "{name}", "parameters": {{{named}}}}}"#);
            (name, acting)
        })
        .collect()
}

/// Kept as long as the program: the resources are compared with it at any time.
fn bolt(causes: &str) -> Resources {
    let json = BOLT.replace(r#""causes": []"#, &format!(r#""causes": [{causes}]"#));
    Resources::new(Box::leak(json.into_boxed_str()))
}

/// One bolt for each joint cause, by name.
pub fn bolts_with_one_cause() -> Vec<(&'static str, Resources)> {
    let causes = causes().into_iter();
    causes.map(|(name, acting)| (name, bolt(&acting))).collect()
}

/// One bolt with every joint cause there is.
pub fn bolt_with_all_causes() -> Resources {
    let causes: Vec<_> = causes().into_iter().map(|(_, acting)| acting).collect();
    bolt(&causes.join(", "))
}
