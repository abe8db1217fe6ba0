use iwan::{diagnose::prepare::prepare, identify::*};
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let records: Vec<_> = args[1..]
        .iter()
        .map(|p| {
            match iwan::read::file(std::path::Path::new(p), &Default::default())
                .unwrap()
                .measurement
            {
                iwan::record::Measurement::History(r) => r,
                _ => panic!(),
            }
        })
        .collect();
    let bench = prepare(&records);
    println!(
        "{:?} noise {:?}",
        bench.whole.operators.form,
        bench
            .noise
            .iter()
            .map(|n| (n.deviation, n.autoregression, n.repeated))
            .collect::<Vec<_>>()
    );
    let mut p = bench.whole.clone();

    let mut fit = baseline(&p);
    let scale = bench.noise[0].deviation;
    let _ = scale;
    for r in 0..8 {
        println!(
            "{r} chi {:.4} nonzero {}",
            fit.misfit / p.rows() as f64,
            fit.coefficients.iter().filter(|c| **c > 0.0).count()
        );
        p.operators = p.operators.adapted(&fit.coefficients);
        fit = baseline(&p);
    }
    dump(&p, &fit);
    println!(
        "{:?}",
        &p.operators.edges[p.operators.edges.len().saturating_sub(6)..]
    );
    let w: Vec<_> = p
        .operators
        .edges
        .iter()
        .zip(&fit.coefficients[1..])
        .filter(|(_, c)| **c > 0.0)
        .map(|(e, c)| format!("{e:.3e}:{c:.2e}"))
        .collect();
    println!("{:?}", w);
}
#[allow(dead_code)]
fn dump(p: &Problem, fit: &Fit) {
    let pr = fit.predict(p);
    let (u, f) = p.channels(0);
    let mut o = String::new();
    for i in 0..u.len() {
        o += &format!("{} {:e} {:e} {:e}\n", i, u[i], f[i], f[i] - pr[0].judged[i]);
    }
    std::fs::write("/tmp/res.txt", o).unwrap();
}
