//! Tests of quantities.

use super::*;

fn si<D: Dimension>(text: &str) -> f64 {
    text.parse::<Quantity<D>>()
        .unwrap_or_else(|error| panic!("{error}"))
        .si()
}

fn close(a: f64, b: f64) {
    assert!((a - b).abs() <= 1e-12 * b.abs(), "{a} is not {b}");
}

#[test]
fn reads_the_units_of_the_field() {
    close(si::<dimension::OfLength>("4.8 mm"), 4.8e-3);
    close(si::<dimension::OfLength>(".5inch"), 0.0127);
    close(si::<dimension::OfVelocity>("1000 ft/s"), 304.8);
    close(si::<dimension::OfVelocity>("1000 mph"), 447.04);
    close(si::<dimension::OfMass>("100 grain"), 6.479891e-3);
    close(si::<dimension::OfMass>("12.7 g"), 0.0127);
    close(si::<dimension::OfPressure>("443 MPa"), 443e6);
    close(si::<dimension::OfPressure>("1 psi"), 6894.757293168361);
    close(si::<dimension::OfPressure>("50 ksi"), 344.73786465841805e6);
    close(si::<dimension::OfDensity>("8500 kg/m3"), 8500.0);
    close(si::<dimension::OfDensity>("8.5 g/cm³"), 8500.0);
    close(si::<dimension::OfTime>("12 µs"), 12e-6);
    close(si::<dimension::OfTime>("12 μs"), 12e-6);
    close(si::<dimension::OfTemperature>("20 celsius"), 293.15);
    close(si::<dimension::OfTemperature>("293.15 kelvin"), 293.15);
    close(
        si::<dimension::OfAngle>("180 degrees"),
        std::f64::consts::PI,
    );
    close(si::<dimension::OfSpecificHeat>("383 J/(kg K)"), 383.0);
    close(si::<dimension::OfStrainRate>("1e-3 1/s"), 1e-3);
}

#[test]
fn says_what_is_wrong() {
    let message = |text: &str| text.parse::<Length>().unwrap_err().to_string();
    assert!(message("4.8").starts_with("the unit is missing after `4.8`"));
    assert!(message("4.8 kg").starts_with("`kg` is a unit of mass, but a length is due here"));
    assert!(message("3 ells").starts_with("`ells` is not a known unit"));
    assert!(message("nan mm").starts_with("`nan mm` is not a number with a unit"));
    for text in ["1e999 mm", "-1.5e-400 mm"] {
        let said = format!("`{text}` is beyond the range of 64-bit floats");
        assert!(message(text).starts_with(&said));
    }
    assert_eq!("0.0e-400 mm".parse::<Length>().unwrap().si(), 0.0);
    assert_eq!("0.0 1/K".parse::<InverseTemperature>().unwrap().si(), 0.0);
    assert!(message("4,8 mm").starts_with("the number of `4,8 mm` has a comma"));
    assert!(message("4.8 MM").contains("did you mean `mm`?"));
    assert!(message("").starts_with("`` is not a number"));
    assert!(message("mm 4").contains("units: m, cm, mm, um, in, ft, mil"));
}

#[test]
fn displays_in_the_unit_that_reads_best() {
    assert_eq!(Length::new(4.8e-3).to_string(), "4.8 mm");
    assert_eq!(Pressure::new(114e9).to_string(), "114 GPa");
    assert_eq!(Pressure::new(443e6).to_string(), "443 MPa");
    assert_eq!(Time::new(4.864e-9).to_string(), "4.864 ns");
    assert_eq!(Temperature::new(294.0).to_string(), "294 K");
    assert_eq!(Length::new(0.0).to_string(), "0 m");
    assert_eq!(significant(1234567.0, 6), "1234567");
    assert_eq!(significant(0.000012345678, 6), "1.23457e-5");
}

#[test]
fn display_reads_back() {
    for si in [1e-9, 0.32e-3, 1.0, 4.25e7] {
        let text = Length::new(si).to_string();
        close(text.parse::<Length>().unwrap().si(), si);
    }
}
