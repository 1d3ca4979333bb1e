//! Clients that hold connections without reading or without a token do not lock others out.

use std::{
    io::{ErrorKind, Read, Write},
    net::{SocketAddr, TcpStream},
    thread,
    time::{Duration, Instant},
};

use percuss_serve::Options;

use crate::support::{Served, read};

/// Requests that are sent ahead: their responses are more than any buffer holds.
const PIPELINED: usize = 4000;

fn get(host: SocketAddr, headers: &str) -> Vec<u8> {
    format!("GET / HTTP/1.1\r\nHost: {host}\r\n{headers}\r\n").into_bytes()
}

/// Connections that send requests and read nothing.
fn attack(served: &Served, count: usize, headers: &str) -> Vec<TcpStream> {
    let requests = get(served.address, headers).repeat(PIPELINED);
    let connect = |_| {
        let mut stream = TcpStream::connect(served.address).ok()?;
        stream
            .set_write_timeout(Some(Duration::from_millis(20)))
            .unwrap();
        let mut rest = &requests[..];
        while !rest.is_empty() {
            match stream.write(rest) {
                Ok(written) => rest = &rest[written..],
                Err(error) if error.kind() == ErrorKind::Interrupted => {}
                // Full, or closed because there are too many.
                Err(_) => break,
            }
        }
        Some(stream)
    };
    (0..count).filter_map(connect).collect()
}

/// Time until a page is answered, asked for again where the connection is closed.
fn answered(served: &Served, headers: &str) -> Duration {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(100) {
        let Ok(mut stream) = TcpStream::connect(served.address) else {
            continue;
        };
        stream
            .set_read_timeout(Some(Duration::from_secs(100)))
            .unwrap();
        let request = get(served.address, &format!("Connection: close\r\n{headers}"));
        if stream.write_all(&request).is_ok() && read(&mut stream).status == 200 {
            return start.elapsed();
        }
        thread::sleep(Duration::from_millis(100));
    }
    panic!("no answer in {:?}", start.elapsed());
}

#[test]
fn clients_that_do_not_read_are_given_up() {
    let served = Served::new(Options::default());
    let held = attack(&served, 300, "");
    let time = answered(&served, "");
    println!("{} connections held, answered after {time:?}", held.len());
    drop(held);
}

/// Connections that ask, read and stay open.
fn stay(served: &Served, count: usize, status: u32) -> Vec<TcpStream> {
    let request = format!(
        "GET /assets/none HTTP/1.1\r\nHost: {}\r\n\r\n",
        served.address
    );
    let connect = |_| {
        let mut stream = TcpStream::connect(served.address).unwrap();
        stream.write_all(request.as_bytes()).unwrap();
        // It stays open after the response: there is no end to read to.
        let mut start = [0; 12];
        stream.read_exact(&mut start).unwrap();
        assert_eq!(start, format!("HTTP/1.1 {status}").as_bytes());
        stream
    };
    (0..count).map(connect).collect()
}

#[test]
fn clients_that_stay_give_way() {
    let served = Served::new(Options::default());
    let held = stay(&served, 256, 404);
    let time = answered(&served, "");
    println!("{} connections stay, answered after {time:?}", held.len());
    assert!(time < Duration::from_secs(5), "{time:?}");
}

#[test]
fn clients_that_stay_without_the_token_give_way() {
    let token = "0123456789abcdef0123456789abcdef";
    let served = Served::new(Options {
        token: Some(token.to_owned()),
        ..Options::default()
    });
    let held = stay(&served, 192, 401);
    let time = answered(&served, &format!("Cookie: percuss_token={token}\r\n"));
    println!("{} connections stay, answered after {time:?}", held.len());
    assert!(time < Duration::from_secs(5), "{time:?}");
}

/// The same with and without the token.
#[test]
fn clients_without_the_token_lock_nobody_out() {
    let token = "0123456789abcdef0123456789abcdef";
    let served = Served::new(Options {
        token: Some(token.to_owned()),
        ..Options::default()
    });
    let known = format!("Cookie: percuss_token={token}\r\n");
    let mut held = attack(&served, 200, "");
    held.extend(attack(&served, 100, &known));
    let time = answered(&served, &known);
    println!("{} connections held, answered after {time:?}", held.len());
    drop(held);
}
