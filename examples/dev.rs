use iwan::diagnose::{prepare::*, search::*, structure::*};
use iwan::identify::*;
use iwan::record::Measurement;
use rayon::prelude::*;
fn main() {
    let dirs: Vec<String> = std::env::args().skip(1).collect();
    let out: Vec<String> = dirs
        .par_iter()
        .map(|d| {
            let mut records = vec![];
            let mut paths: Vec<_> = std::fs::read_dir(format!("{d}/records"))
                .unwrap()
                .map(|e| e.unwrap().path())
                .collect();
            paths.sort();
            for p in &paths {
                let l = iwan::read::file(p, &Default::default()).unwrap();
                if let Measurement::History(r) = l.measurement {
                    records.push(r)
                }
            }
            let t = std::time::Instant::now();
            let mut bench = prepare(&records);
            let mut f = search(&bench, true, baseline(&bench.train));
            if !bench.noise_is_repeated() {
                let n = bench.noise_from(&f.best);
                bench.weigh(n);
                f = search(&bench, true, baseline(&bench.train));
                let n = bench.noise_from(&f.best);
                bench.weigh(n);
            }
            let n = bench.train.rows() as f64;
            let sb = structure(&bench.whole, &f.baseline.predict(&bench.whole));
            let se = structure(&bench.whole, &f.best.predict(&bench.whole));
            let mut o = format!(
                "{:28} {:?} n {n} rep {} ar {:.2} chi0 {:.3} ",
                d.split('/').last().unwrap(),
                bench.train.operators.form,
                bench.noise[0].repeated,
                bench.noise[0].autoregression,
                f.baseline.misfit / n
            );
            o += &format!(
                "chi1 {:.3} {:?} riv {:?} ev {:?} {:?} ",
                f.best.misfit / n,
                f.best.effects,
                f.rivals,
                f.evidence,
                t.elapsed()
            );
            o += &format!(
                "\n      struct {:.3} ({:.1}) -> {:.4} ({:.1})   ",
                sb.share, sb.significance, se.share, se.significance
            );
            for t in f.trials.iter().take(4) {
                o += &format!("{}: {:.1}  ", t.cause.name(), t.evidence);
            }
            o
        })
        .collect();
    for o in out {
        println!("{o}");
    }
}
