//! `percuss serve` refuses what is not safe and says where it serves.

use std::{
    fs,
    io::{BufRead, BufReader, Read, Write},
    net::{TcpListener, TcpStream},
    path::Path,
    process::{Command, Stdio},
};

use crate::support::{flat, folder_with, percuss};

/// Arguments that are refused, and words of the answer.
fn refused(arguments: &[&str], words: &[&str]) {
    let folder = tempfile::tempdir().unwrap();
    let said = percuss(folder.path(), [&["serve"][..], arguments].concat());
    let text = flat(&said.stderr);
    assert_eq!(said.code, 2, "{arguments:?}: {text}");
    for words in words {
        assert!(text.contains(words), "{arguments:?}: {text}");
    }
}

#[test]
fn what_is_not_safe_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let short = folder.path().join("short.txt");
    fs::write(&short, "secret\n").unwrap();
    let short = short.display().to_string();
    refused(
        &["--address", "0.0.0.0", "--port", "0"],
        &["0.0.0.0 is not a loopback address", "help: ", "ssh -L"],
    );
    refused(
        &["--address", "0.0.0.0", "--port", "0", "--allow-remote"],
        &["--token-file"],
    );
    refused(
        &["--port", "0", "--token-file", &short],
        &["a token has 16 to 200 letters", "openssl rand"],
    );
}

#[test]
fn a_port_that_is_taken_and_a_case_that_is_not_valid_are_named() {
    let taken = TcpListener::bind("127.0.0.1:0").unwrap();
    let port = taken.local_addr().unwrap().port().to_string();
    refused(
        &["--port", &port],
        &["cannot listen on 127.0.0.1", "--port 0"],
    );
    let bad = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/bad-cases");
    let case = fs::read_dir(bad)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .find(|path| path.extension().is_some_and(|end| end == "toml"))
        .unwrap();
    let case = case.display().to_string();
    let here = Path::new(".");
    let run = percuss(here, ["run", &case]);
    let served = percuss(here, ["serve", "--port", "0", &case]);
    assert_eq!((served.code, served.stderr), (run.code, run.stderr));
}

#[test]
fn the_first_line_says_where_the_page_is() {
    let page = page_of(concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../cases/taylor-copper-wilkins/scenario.toml"
    ));
    assert!(page.starts_with("HTTP/1.1 200"), "{page}");
    assert!(page.contains("final projectile length"), "{page}");
    assert!(page.contains("taylor-copper-wilkins"), "{page}");
}

/// The page gets the text of the case with all that it names.
#[test]
fn materials_of_files_are_in_the_text_of_the_page() {
    let case = "material_files = ['metals.toml']\n\
        projectile = { material = 'soft', length = '20 mm', diameter = '5 mm', impact_velocity = '200 m/s' }\n\
        target = { rigid_wall = true }\n";
    let metals = "[soft]\nname = 'Soft metal of a file'\ndensity = '8000 kg/m3'\n\
        youngs_modulus = '100 GPa'\npoissons_ratio = 0.3\nstrength.perfectly_plastic.flow_stress = '300 MPa'\n";
    let folder = folder_with(&[("case.toml", case), ("metals.toml", metals)]);
    let page = page_of(&folder.path().join("case.toml").display().to_string());
    assert!(page.starts_with("HTTP/1.1 200"), "{page}");
    assert!(page.contains("Soft metal of a file"), "{page}");
}

/// Answer to the first request of a served case.
fn page_of(case: &str) -> String {
    let mut child = Command::new(env!("CARGO_BIN_EXE_percuss"))
        .args(["serve", "--port", "0", case])
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    BufReader::new(child.stdout.take().unwrap())
        .read_line(&mut line)
        .unwrap();
    let address = line.trim().strip_prefix("serving http://").unwrap();
    let mut stream = TcpStream::connect(address).unwrap();
    let request = format!("GET / HTTP/1.1\r\nHost: {address}\r\nConnection: close\r\n\r\n");
    stream.write_all(request.as_bytes()).unwrap();
    let mut page = String::new();
    stream.read_to_string(&mut page).unwrap();
    child.kill().unwrap();
    child.wait().unwrap();
    page
}
