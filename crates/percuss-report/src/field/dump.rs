//! Fields of particles as dumps of LAMMPS, which OVITO reads: a text file per frame, in SI units.

use std::{
    fmt::Write as _,
    path::{Path, PathBuf},
};

use super::{
    FieldSeries, clear, damaged, read,
    vtp::{POINTS, SIDES},
    vtp_points::{bodies, time, values},
};
use crate::{ReportError, replace_file::replace_file};

/// Folder of the files, and how their names end.
const FOLDER: &str = "dump";
const ENDING: &str = ".dump";
/// Scalars of a particle, as both files name them.
const SCALARS: [&str; 6] = [
    "pressure",
    "von_mises_stress",
    "plastic_strain",
    "temperature",
    "density",
    "damage",
];

/// Writes the frames of a series as dumps in the place of earlier ones; returns their folder.
///
/// # Errors
/// [`ReportError::Read`] and [`ReportError::Write`].
pub fn write_dumps(out: &Path, series: &FieldSeries) -> Result<PathBuf, ReportError> {
    let folder = out.join(FOLDER);
    clear(&folder, ENDING);
    for (number, path) in series.files() {
        let text = dump(&read(&path)?, number).ok_or_else(|| damaged(&path))?;
        let name = format!("frame-{number:05}{ENDING}");
        replace_file(&folder, &name, text.as_bytes())?;
    }
    Ok(folder)
}

/// The dump of a field file; `None` when it has no particles. Positions and axes are those of the file; the time step is the number of the frame.
fn dump(file: &[u8], number: u64) -> Option<String> {
    let vectors = |name: &str| values(file, name, 3);
    let (places, velocities) = (vectors(POINTS)?, vectors("velocity")?);
    let (bodies, sides) = (bodies(file)?, values(file, SIDES, 2)?);
    let scalars = SCALARS.map(|name| values(file, name, 1));
    // A particle is drawn as a ball as large as its section before the impact.
    let radius = |i: usize| 0.5 * (sides[2 * i] * sides[2 * i + 1]).sqrt();
    let largest = (0..bodies.len()).map(radius).fold(0.0, f32::max);
    let mut text = format!(
        "ITEM: UNITS\nsi\nITEM: TIME\n{:e}\nITEM: TIMESTEP\n{number}\nITEM: NUMBER OF ATOMS\n{}\nITEM: BOX BOUNDS ss ss ss\n",
        time(file)?,
        bodies.len()
    );
    for axis in 0..3 {
        let along = places.iter().skip(axis).step_by(3);
        let range = along.fold([f32::INFINITY, f32::NEG_INFINITY], |[low, high], place| {
            [low.min(*place), high.max(*place)]
        });
        // Writing to a string does not fail.
        let _ = writeln!(text, "{:e} {:e}", range[0] - largest, range[1] + largest);
    }
    let names = SCALARS.join(" ");
    let _ = writeln!(text, "ITEM: ATOMS id type x y z vx vy vz radius {names}");
    for (i, body) in bodies.iter().enumerate() {
        let _ = write!(text, "{} {}", i + 1, u32::from(*body) + 1);
        for number in places[3 * i..][..3].iter().chain(&velocities[3 * i..][..3]) {
            let _ = write!(text, " {number:e}");
        }
        let _ = write!(text, " {:e}", radius(i));
        for scalar in &scalars {
            let _ = write!(text, " {:e}", scalar.as_ref()?.get(i)?);
        }
        text.push('\n');
    }
    Some(text)
}

#[cfg(test)]
mod tests {
    use std::fs;

    use percuss::axi::Particle;

    use super::{super::vtp::tests::frame, *};

    #[test]
    fn a_dump_has_the_numbers_of_the_frame() {
        let particle = |radius: f64, damage: f64| Particle {
            position: [radius, 5e-3],
            velocity: [3.0, 4.0],
            mass: 2e-6,
            volume: 1e-9,
            sides: [1e-4, 4e-4],
            damage,
            ..Particle::default()
        };
        let bodies = [[particle(1e-3, 0.0)], [particle(2e-3, 0.5)]];
        let frame = frame(7, &bodies, Vec::new());
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join(FOLDER)).unwrap();
        let stale = folder.path().join(FOLDER).join("frame-00900.dump");
        fs::write(&stale, "").unwrap();
        let mut series = FieldSeries::create(folder.path(), 4).unwrap();
        series.add(&frame).unwrap();
        let dumps = write_dumps(folder.path(), &series).unwrap();
        assert!(!stale.exists());
        let text = fs::read_to_string(dumps.join("frame-00007.dump")).unwrap();
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(
            lines[..8],
            [
                "ITEM: UNITS",
                "si",
                "ITEM: TIME",
                "1.5e-6",
                "ITEM: TIMESTEP",
                "7",
                "ITEM: NUMBER OF ATOMS",
                "2"
            ]
        );
        let heads: Vec<&str> = lines[12].split_whitespace().skip(2).collect();
        let rows = [13, 14].map(|line| {
            let numbers = lines[line].split_whitespace().map(|n| n.parse().unwrap());
            numbers.collect::<Vec<f32>>()
        });
        let value = |row: usize, name: &str| {
            rows[row][heads.iter().position(|head| *head == name).unwrap()]
        };
        assert_eq!([heads.len(), lines.len()], [rows[0].len(), 15]);
        for (name, of_rows) in [
            ("id", [1.0, 2.0]),
            ("type", [1.0, 2.0]),
            ("x", [1e-3, 2e-3]),
            ("y", [-5e-3, -5e-3]),
            ("vx", [3.0, 3.0]),
            ("vy", [-4.0, -4.0]),
            ("radius", [1e-4, 1e-4]),
            ("damage", [0.0, 0.5]),
        ] {
            for (row, expected) in of_rows.into_iter().enumerate() {
                let error = (value(row, name) - expected).abs();
                assert!(error <= 3e-4 * expected.abs(), "{name}");
            }
        }
    }
}
