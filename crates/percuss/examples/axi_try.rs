use percuss::{
    case,
    model::{self, Control},
};
use std::time::Instant;
fn main() {
    let mut args = std::env::args().skip(1);
    let path = args.next().unwrap();
    let speed: f64 = args.next().unwrap().parse().unwrap();
    let extra = args.collect::<Vec<_>>().join("\n");
    let text = std::fs::read_to_string(&path).unwrap();
    let text = if extra.is_empty() {
        text
    } else {
        format!("{text}\n[axi]\n{extra}\n")
    };
    let scenario = case::load_str("try", &text).unwrap().at_speed(speed);
    let start = Instant::now();
    let mut next = 0.0;
    let mut progress = |p: model::Progress| {
        if p.time >= next {
            next += 5e-6;
            eprintln!(
                "{} t {:.2} us depth {:.4} mm f {:.2}",
                p.step,
                p.time * 1e6,
                p.depth * 1e3,
                p.fraction
            );
        }
        std::ops::ControlFlow::Continue(())
    };
    let mut control = Control {
        record: false,
        progress: Some(&mut progress),
        ..Control::default()
    };
    let result = model::run(&percuss::axi::Axi, &scenario, &mut control).unwrap();
    let wall = start.elapsed().as_secs_f64();
    let n = result.numerics();
    let particles = (n.elements.0 + n.elements.1) as f64;
    println!(
        "{:?} {:?} depth {:?} largest {:?} permanent {:?} L {:?} D {:?} v {:?} end {:?}",
        result.outcome,
        result.termination,
        result.depth_of_penetration,
        result.largest_depth,
        result.permanent_depth,
        result.projectile_final_length,
        result.projectile_final_diameter,
        result.residual_velocity,
        result.end_time
    );
    println!(
        "particles {:?} steps {} wall {wall:.2} s, {:.2} M/s; residual E {:.2e} p {:.2e}",
        n.elements,
        n.steps,
        particles * n.steps as f64 / wall / 1e6,
        n.energy_residual,
        n.momentum_residual
    );
    for (l, v) in n.energy.lines() {
        println!("  {l} {:.2} %", 100.0 * v / n.energy.initial);
    }
    for d in &result.details {
        println!("  {} {} {}", d.name, d.value, d.unit);
    }
    for w in &result.warnings {
        println!("  ! {w}");
    }
}
