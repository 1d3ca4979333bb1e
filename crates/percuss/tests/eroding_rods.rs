//! measure
mod common;
use common::scenario;
use percuss::{
    analytic::Rods,
    model::{self, Control},
};

fn case(rho: (f64, f64), y: f64, factor: f64, v: f64, ld: f64, opts: &str) -> String {
    format!(
        r#"
        projectile = {{ material = "rod", length = "{} mm", diameter = "10 mm", velocity = "{v} m/s" }}
        target = {{ material = "tgt", thickness = "{} mm" , back_face = "non-reflecting"}}
        [chain]
        constraint_factor = {factor}
        border_shear = 0.0
        {opts}
        [materials.rod]
        name = "rod"
        density = "{} kg/m3"
        youngs_modulus = "200 GPa"
        poissons_ratio = 0.3
        strength.perfectly_plastic = {{ flow_stress = "{y} MPa" }}
        [materials.tgt]
        name = "tgt"
        density = "{} kg/m3"
        youngs_modulus = "200 GPa"
        poissons_ratio = 0.3
        strength.perfectly_plastic = {{ flow_stress = "{y} MPa" }}
        "#,
        ld * 10.0,
        ld * 10.0 * 4.0,
        rho.0,
        rho.1
    )
}

#[test]
#[ignore]
fn measure() {
    let ld = 10.0;
    let l = 0.1;
    for (name, opts) in [
        ("default", "projectile_elements=100\ntarget_elements=400".to_owned()),
        ("small .97", "kinematics=\"small-strain\"\nerosion_strain=0.97\ncourant=0.05\nprojectile_elements=100\ntarget_elements=400".to_owned()),
    ] {
    for rho in [(7850.,7850.),(17600.,7850.),(2700.,7850.)] {
        for (y,f) in [(800.0, 1.0),(800.0,4.0)] {
        for v in [1000.0,1500.,2000.,3000.0] {
            let rods = Rods{projectile_density:rho.0,target_density:rho.1,projectile_strength:y*1e6,target_resistance:y*f*1e6};
            let stop = rods.penetrate(v,l).unwrap();
            let s = scenario(&case(rho,y,f,v,ld,&opts));
            match model::run(model::model("chain").unwrap(), &s, &mut Control::recording()) {
                Ok(r) => {
                    let t = stop.time;
                    let samples = &r.history.as_ref().unwrap().samples;
                    let at = |time: f64| samples.iter().find(|s| s.time>=time).map(|s| s.depth).unwrap_or(f64::NAN);
                    let u = (at(0.4*t)-at(0.1*t))/(0.3*t);
                    // Tate mean speed over the same span: use initial
                    println!("{name} {rho:?} Y{y} f{f} V{v}: U {u:.0} tate {:.0} ratio {:.3}; depth {:.2} tate {:.2} ratio {:.3} {:?} steps {}", rods.penetration_speed(v), u/rods.penetration_speed(v), r.depth_of_penetration.unwrap()*1e3, stop.depth*1e3, r.depth_of_penetration.unwrap()/stop.depth, r.termination, r.numerics().steps);
                }
                Err(e) => println!("{name} {rho:?} Y{y} f{f} V{v}: {e}"),
            }
        }}
    }}
}
