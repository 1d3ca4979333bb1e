//! Requests at random: each gets a whole response, and the memory of the server stays where it was.
//!
//! Several clients at once. `PERCUSS_REQUESTS` sets how many requests, `PERCUSS_SEED` which.

#![cfg(target_os = "linux")]

use std::{
    collections::BTreeMap,
    io::{BufRead, BufReader, Read, Write},
    net::{Shutdown, TcpStream},
    process::{Child, Command, Stdio},
    sync::{
        Mutex,
        atomic::{AtomicUsize, Ordering},
    },
    thread,
    time::Duration,
};

use serde_json::{Value, json};

use crate::support::{Draw, memory_of, status};

const PAPER: &str = include_str!("../../../cases/paper-table1/scenario.toml");

/// A server in a process of its own, whose memory is nobody else's.
struct Served {
    process: Child,
    address: String,
}

impl Served {
    fn new() -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_percuss"))
            .args(["serve", "--port", "0", "--max-seconds", "2"])
            // As in the `Containerfile`: what is freed goes back at once, so that memory that grows is memory that is held.
            .env("MALLOC_ARENA_MAX", "1")
            .env("MALLOC_MMAP_THRESHOLD_", "131072")
            .stdout(Stdio::piped())
            .spawn()
            .unwrap();
        let mut line = String::new();
        let stdout = process.stdout.take().unwrap();
        BufReader::new(stdout).read_line(&mut line).unwrap();
        let address = line.trim().strip_prefix("serving http://").unwrap();
        Self {
            address: address.to_owned(),
            process,
        }
    }

    /// Sends bytes as they are; gives the status, 0 for none, and the response.
    fn raw(&self, request: &[u8], then: Then) -> (u32, Vec<u8>) {
        let mut stream = TcpStream::connect(&self.address).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(120)))
            .unwrap();
        // A server may refuse a request before it has read all of it, and close before the end.
        let _ = stream.write_all(request);
        match then {
            Then::Waits => {}
            Then::ClosesItsHalf => {
                let _ = stream.shutdown(Shutdown::Write);
            }
            Then::GoesAway => return (0, Vec::new()),
        }
        let mut response = Vec::new();
        let _ = stream.read_to_end(&mut response);
        (status(&response), response)
    }
}

impl Drop for Served {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

/// Clients that send at the same time.
const CLIENTS: usize = 4;
/// The axisymmetric refinement computes until its limit of 2 s: one request in as many asks for it.
const REFINEMENTS: usize = 500;
/// Parts of the test after which the memory is looked at.
const TENTHS: usize = 10;
const PATHS: [&str; 9] = [
    "/api/answer",
    "/api/answer",
    "/api/file",
    "/api/study/compare",
    "/api/study/sweep",
    "/api/study/nothing",
    "/api/uncertainty-example",
    "/api/validation",
    "/",
];

/// What a client does after its request.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Then {
    Waits,
    ClosesItsHalf,
    GoesAway,
}

/// A body: valid, with some bytes changed, or with a value of another kind somewhere.
fn body(draw: &mut Draw) -> Vec<u8> {
    let quick = PAPER.replace("= 40", "= 4").replace("= 80", "= 8");
    let mut asked = json!({
        "name": "shot",
        "case": quick,
        "model": draw.of(&["chain", "crater_energy", "fdm", "none"]),
        "speeds": [100.0, 200.0, 2],
    });
    let others: &[Value] = &[
        Value::Null,
        json!(-1),
        json!(1e308),
        json!("\u{0}\u{ffff}"),
        json!([[[[[]]]]]),
        json!({ "a": {} }),
        json!("x".repeat(2000)),
        json!("y".repeat(100_000)),
    ];
    if draw.below(3) == 0 {
        let key = draw.of(&["name", "case", "model", "speeds", "sweep", "uncertainty"]);
        asked[key] = others[draw.below(others.len())].clone();
    }
    let mut bytes = asked.to_string().into_bytes();
    if draw.below(2) == 0 {
        for _ in 0..=draw.below(6) {
            let place = draw.below(bytes.len());
            match draw.below(3) {
                0 => bytes[place] = draw.below(256) as u8,
                1 => {
                    bytes.remove(place);
                }
                _ => bytes.insert(place, draw.below(256) as u8),
            }
        }
    }
    bytes
}

/// A request, whether it is one of HTTP, and what its client does then.
fn request(draw: &mut Draw, served: &Served) -> (Vec<u8>, bool, Then) {
    let path = match draw.below(REFINEMENTS) {
        0 => "/api/refinement",
        _ => draw.of(&PATHS),
    };
    let body = body(draw);
    let mut request = format!(
        "POST {path} HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Type: application/json\r\nContent-Length: {}\r\n\r\n",
        served.address,
        body.len()
    )
    .into_bytes();
    request.extend_from_slice(&body);
    // Who sends less than it said has to close its half, or would be waited for.
    match draw.below(6) {
        0 => {
            request.truncate(draw.below(request.len()));
            (request, false, Then::ClosesItsHalf)
        }
        1 => {
            for _ in 0..=draw.below(4) {
                let place = draw.below(request.len().min(200));
                request[place] = draw.below(256) as u8;
            }
            (request, false, Then::ClosesItsHalf)
        }
        2 => (request, true, Then::ClosesItsHalf),
        3 if draw.below(10) == 0 => (request, true, Then::GoesAway),
        _ => (request, true, Then::Waits),
    }
}

/// Whether a response has come to its end.
fn is_whole(response: &[u8]) -> bool {
    let blank = response.windows(4).position(|four| four == b"\r\n\r\n");
    let (head, body) = response.split_at(blank.map_or(response.len(), |place| place + 4));
    let head = String::from_utf8_lossy(head).to_lowercase();
    let length = head
        .lines()
        .find_map(|line| line.strip_prefix("content-length: "));
    match (length, head.starts_with("http/1.1 100")) {
        (_, true) => is_whole(body),
        (Some(length), _) => length.parse() == Ok(body.len()),
        (None, _) => body.ends_with(b"0\r\n\r\n"),
    }
}

/// Sends requests until all are sent; gives how many had each status.
fn send(
    served: &Served,
    seed: u64,
    sent: &AtomicUsize,
    memory: &Mutex<Vec<u64>>,
) -> BTreeMap<u32, u64> {
    let count = requests();
    let mut draw = Draw(seed);
    let mut by_status = BTreeMap::new();
    loop {
        let number = sent.fetch_add(1, Ordering::Relaxed);
        if number >= count {
            return by_status;
        }
        let (bytes, is_request, then) = request(&mut draw, served);
        let (status, response) = served.raw(&bytes, then);
        *by_status.entry(status).or_insert(0) += 1;
        assert!(status != 500, "{}", String::from_utf8_lossy(&bytes));
        assert!(
            !is_request || then == Then::GoesAway || is_whole(&response),
            "{then:?}: {} gave {}",
            String::from_utf8_lossy(&bytes),
            String::from_utf8_lossy(&response)
        );
        // A refusal gives the text of the case back, and little else.
        assert!(
            status < 400 || response.len() < 20_000 + bytes.len(),
            "{}",
            String::from_utf8_lossy(&response)
        );
        if number.is_multiple_of((count / TENTHS).max(1)) {
            memory
                .lock()
                .unwrap()
                .push(memory_of(served.process.id())[0]);
        }
    }
}

fn requests() -> usize {
    std::env::var("PERCUSS_REQUESTS").map_or(500, |text| text.parse().unwrap())
}

#[test]
fn requests_at_random_are_answered_in_flat_memory() {
    let served = Served::new();
    let seed: u64 = std::env::var("PERCUSS_SEED").map_or(11, |text| text.parse().unwrap());
    let (sent, memory) = (AtomicUsize::new(0), Mutex::default());
    let mut by_status: BTreeMap<u32, u64> = BTreeMap::new();
    thread::scope(|scope| {
        let clients = (0..CLIENTS).map(|client| {
            let seed = seed.wrapping_mul(1000) + client as u64;
            let (served, sent, memory) = (&served, &sent, &memory);
            scope.spawn(move || send(served, seed, sent, memory))
        });
        for client in clients.collect::<Vec<_>>() {
            for (status, number) in client.join().unwrap() {
                *by_status.entry(status).or_default() += number;
            }
        }
    });
    let memory = memory.into_inner().unwrap();
    let settled = memory[TENTHS / 2];
    let [end, _] = memory_of(served.process.id());
    let mib: Vec<u64> = memory
        .iter()
        .chain([&end])
        .map(|bytes| bytes >> 20)
        .collect();
    println!("{by_status:?}, memory at each tenth {mib:?} MiB");
    assert!(by_status.contains_key(&200) && by_status.contains_key(&400));
    assert!(end.saturating_sub(settled) < 16 << 20, "{mib:?} MiB");
    let page = format!(
        "GET / HTTP/1.1\r\nHost: {}\r\nConnection: close\r\n\r\n",
        served.address
    );
    assert_eq!(served.raw(page.as_bytes(), Then::Waits).0, 200);
}
