//! Tests of tables of materials.

use super::*;
use crate::{
    case::materials_toml,
    material::{Library, MaterialTable},
};

fn library() -> MaterialTable {
    let entries = Library::built_in().iter();
    let record =
        |entry: &crate::material::MaterialEntry| (entry.id.clone(), (*entry.material).clone());
    entries.map(record).collect()
}

/// Every record of the library, to the digits of its text.
#[test]
fn what_is_written_is_read_again() {
    let records = library();
    assert!(records.len() > 60);
    let written = csv(&records).unwrap();
    let from_csv = read_csv("all.csv", &written).unwrap();
    assert_eq!(from_csv.warnings, [""; 0]);
    let from_json = read_json("all.json", &json(&records).unwrap()).unwrap();
    for read in [from_csv.records, from_json.records] {
        assert_eq!(read.len(), records.len());
        for (id, record) in records.clone() {
            let text = |record| materials_toml(&MaterialTable::from([(id.clone(), record)]));
            assert_eq!(text(read[&id].clone()), text(record), "{id}");
        }
    }
}

#[test]
fn units_stand_in_the_cell_or_in_the_name_of_the_column() {
    let cells = "id,name,density,youngs_modulus,poissons_ratio,specific_heat,strength.perfectly_plastic.flow_stress\n\
                 foam,304,30 kg/m3,20 MPa,0.1,900 J/(kg K),400 kPa\n";
    let names = "id,name,density (kg/m3),youngs_modulus [MPa],poissons_ratio,specific_heat (J/(kg K)),strength.perfectly_plastic.flow_stress (kPa)\n\
                 foam,304,30,20,0.1,900,400\n";
    let first = read_csv("a.csv", cells).unwrap();
    assert_eq!(first, read_csv("b.csv", names).unwrap());
    let foam = &first.records["foam"];
    assert_eq!((foam.name.as_str(), foam.density.si()), ("304", 30.0));
}

#[test]
fn a_record_without_a_name_has_that_of_its_id() {
    let text = "id,density,youngs_modulus,poissons_ratio,strength.perfectly_plastic.flow_stress\n\
                foam,30 kg/m3,20 MPa,0.1,400 kPa\n";
    let read = read_csv("a.csv", text).unwrap();
    assert_eq!(read.records["foam"].name, "foam");
    let json = json(&read.records)
        .unwrap()
        .replace("\"foam\",\n", "\"\",\n");
    assert_eq!(read_json("a.json", &json).unwrap().records, read.records);
}

#[test]
fn other_columns_are_named_and_not_read() {
    let text = "id,name,density,youngs_modulus,poissons_ratio,strength.perfectly_plastic.flow_stress,price\n\
                foam,Foam,30 kg/m3,20 MPa,0.1,400 kPa,12\n";
    let read = read_csv("a.csv", text).unwrap();
    assert_eq!(
        read.warnings,
        ["column `price` is not read: no key of a material"]
    );
}

#[test]
fn what_is_wrong_is_refused_with_its_place() {
    let header =
        "id,name,density,youngs_modulus,poissons_ratio,strength.perfectly_plastic.flow_stress\n";
    for (row, place, message) in [
        (
            "foam,Foam,30,20 MPa,0.1,400 kPa",
            "a.csv:2: `density`",
            "the unit is missing",
        ),
        (
            "foam,Foam,30 kg/m3,20 kg,0.1,400 kPa",
            "a.csv:2: `youngs_modulus`",
            "`kg` is a unit of mass",
        ),
        (
            "foam,Foam,30 kg/m3,20 MPa,0.7,400 kPa",
            "a.csv:2: `poissons_ratio`",
            "0.7 is out of range",
        ),
        (
            "foam,Foam,30 kg/m3,20 MPa,0.1,",
            "a.csv:2: `id`",
            "strength",
        ),
        (
            ",Foam,30 kg/m3,20 MPa,0.1,400 kPa",
            "a.csv:2: `id`",
            "`id` is empty",
        ),
    ] {
        let error = read_csv("a.csv", &format!("{header}{row}\n"));
        let error = error.unwrap_err().to_string();
        assert!(
            error.contains(place) && error.contains(message),
            "{row}: {error}"
        );
    }
    let near = header.replace("density", "densitiy");
    let error = read_csv("a.csv", &near).unwrap_err().to_string();
    assert!(error.contains("no column is named `densitiy`"), "{error}");

    let record = "{\"foam\": {\"name\": \"Foam\", \"density\": \"30 kg/m3\",\n \"youngs_modulus\": \"20 MPa\", \"poissons_ratio\": 0.7,\n \
                  \"strength\": {\"perfectly_plastic\": {\"flow_stress\": \"400 kPa\"}}}}";
    for (text, place, message) in [
        (
            record.to_owned(),
            "a.json:2: `foam.poissons_ratio`",
            "0.7 is out of range",
        ),
        (
            record.replace("20 MPa", "20"),
            "a.json:1: `foam`",
            "the unit is missing",
        ),
        (record.replace("}}}}", "}}}"), "a.json:3", "EOF"),
        ("[]".to_owned(), "a.json", "no object"),
        (
            record.replace("\"poissons_ratio\"", "\"density\""),
            "a.json:2",
            "the key `density` is given twice",
        ),
        (
            format!("{{{}, {}", &record[1..record.len() - 1], &record[1..]),
            "a.json:3",
            "the key `foam` is given twice",
        ),
    ] {
        let error = read_json("a.json", &text).unwrap_err().to_string();
        assert!(
            error.contains(place) && error.contains(message),
            "{text}: {error}"
        );
    }
}
