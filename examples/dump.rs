use iwan::{causes, diagnose::prepare::prepare, identify::*, joint::effect::Acting};
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let records: Vec<_> = args[2..].iter().map(|p| match iwan::read::file(std::path::Path::new(p), &Default::default()).unwrap().measurement { iwan::record::Measurement::History(r) => r, _ => panic!() }).collect();
    let bench = prepare(&records);
    let base = baseline(&bench.whole);
    let mut fit = base.clone();
    if args[1] != "none" {
        let c = causes::find(&args[1]).unwrap();
        let starts: Vec<_> = c.starts(&bench.scale).into_iter().map(|values| Acting { effect: c.effect(), values }).collect();
        for s in scores(&bench.whole, &base, &starts) { let f = refit(&bench.whole, &base, vec![s.acting.clone()]); if f.misfit < fit.misfit { fit = f; } }
    }
    eprintln!("{:?} base {} fit {} {:?} noise {:?}", bench.whole.operators.form, base.misfit, fit.misfit, fit.effects.iter().map(|e|&e.values).collect::<Vec<_>>(), bench.noise.iter().map(|n|(n.deviation,n.autoregression)).collect::<Vec<_>>());
    let p = fit.predict(&bench.whole);
    for k in 0..records.len() { let (x, y) = bench.whole.channels(k); for i in 0..y.len() { println!("{k} {} {} {} {}", bench.whole.records[k].time[i], x[i], y[i], (y[i]-p[k].judged[i])/bench.noise[k].deviation); } }
}
