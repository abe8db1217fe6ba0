//! What is computed: the network's law, the family's density, the causes' laws.

use crate::causes;
use crate::joint::{Density, Joint};
use quick_xml::escape::escape;
use std::fmt::Write as _;

/// The section.
pub fn section(page: &mut String, joint: &Joint) {
    page.push_str("<h2>Equations</h2>\n");
    page.push_str(NETWORK);
    let _ = writeln!(page, "<p>{}</p>", density(&joint.density));
    page.push_str(if joint.effects.is_empty() {
        EXACT
    } else {
        EXTENDED
    });
    for acting in &joint.effects {
        cause(page, acting.effect.name());
    }
}

fn density(density: &Density) -> &'static str {
    match density {
        Density::PowerLaw(_) => {
            "<code>power_law</code>: &rho;(&phi;) = R &phi;<sup>&chi;</sup> below the break-free \
             limit, the remainder elastic (Eq. 45, 53)."
        }
        Density::PowerLawTable(_) => {
            "<code>power_law_table</code>: &rho;(&phi;) = R &phi;<sup>&chi;</sup> up to the first \
             place of the table, the table of joint.json above it (steps 1 to 6 of the report's \
             procedure)."
        }
        Density::FourParameter(_) => {
            "<code>four_parameter</code>: &rho;(&phi;) = R &phi;<sup>&chi;</sup> for 0 &lt; &phi; \
             &lt; &phi;<sub>max</sub>, and S &delta;(&phi; &minus; &phi;<sub>max</sub>), in terms \
             of F<sub>S</sub>, K<sub>T</sub>, &chi; and &beta;."
        }
        Density::Sliders(_) => {
            "<code>sliders</code>: a finite set, each with its stiffness and the slip at which it \
             lets go; the lists are in joint.json."
        }
    }
}

fn cause(page: &mut String, name: &str) {
    let Some(cause) = causes::find(name) else {
        return;
    };
    let about = cause.page();
    let _ = writeln!(
        page,
        "<h3>Cause <code>{}</code></h3>\n<p>{}</p>\n<p>Law: <code>{}</code>. Source: {}.</p>",
        escape(name),
        escape(about.happens),
        escape(about.formula),
        escape(about.source.trim_end_matches('.')),
    );
}

const NETWORK: &str = "<p>A spring in series with a network of sliders (Segalman's augmented Iwan \
model):</p>
<ul>
<li>F(t) = &int; &rho;(&phi;) k [u(t) &minus; x(&phi;, t)] d&phi;, a slider moving while \
|k (u &minus; x)| = &phi; (Eq. 27, 28)</li>
<li>U = u + F / K<sub>1</sub> (Eq. 52)</li>
<li>virgin curve G(u) with G&Prime;(u) = &minus;k&sup2; &rho;(k u) (Eq. 30, 31)</li>
</ul>
";

const EXTENDED: &str =
    "<p>With the causes below, the network is a finite set of sliders and each step \
solves one rising equation for force and displacement. Turning values of the input must fall on \
communication points, or be told by the input's derivatives; a cause that acts on rates takes the \
mean rate over the step, and a slip limit that changes is that of the last communication point: the \
answer then depends on the communication step, to first order.</p>
";

const EXACT: &str = "<p>The response is exact: Masing's rule with return-point memory on G, or on \
its inverse where force is the input. Between two turning values of the input nothing is \
integrated, so that the answer does not depend on the communication step.</p>
";
