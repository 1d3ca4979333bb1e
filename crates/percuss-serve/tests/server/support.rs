//! A server on a free port and a client that can be as rude as need be.

use std::{
    io::{Read, Write},
    net::{SocketAddr, TcpStream},
    thread,
    time::Duration,
};

use percuss_serve::{Options, Server};
use serde_json::Value;

/// A server that runs until the tests end.
pub struct Served {
    pub address: SocketAddr,
}

/// An answer as it came.
#[derive(Debug)]
pub struct CaseResponse {
    pub status: u16,
    pub head: String,
    pub body: Vec<u8>,
}

impl Served {
    pub fn new(options: Options) -> Self {
        let server = Server::bind(options).unwrap();
        let address = server.address();
        thread::spawn(move || server.run());
        Self { address }
    }

    pub fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(self.address).unwrap();
        stream
            .set_read_timeout(Some(Duration::from_secs(120)))
            .unwrap();
        stream
    }

    /// Sends bytes as they are and reads the answer to its end.
    pub fn raw(&self, request: &[u8]) -> CaseResponse {
        let mut stream = self.connect();
        // A server may refuse a request before it has read all of it.
        let _ = stream.write_all(request);
        read(&mut stream)
    }

    pub fn get(&self, path: &str, headers: &str) -> CaseResponse {
        let host = self.address;
        self.raw(
            format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{headers}\r\n")
                .as_bytes(),
        )
    }

    pub fn post_bytes(&self, path: &str, body: &[u8], headers: &str) -> CaseResponse {
        self.raw(&post_request(self.address, path, body, headers))
    }

    pub fn post(&self, path: &str, body: &Value) -> CaseResponse {
        self.post_bytes(path, body.to_string().as_bytes(), "")
    }
}

/// The bytes of a request that the page would send.
pub fn post_request(host: SocketAddr, path: &str, body: &[u8], headers: &str) -> Vec<u8> {
    let mut request = format!(
        "POST {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Type: application/json\r\nContent-Length: {}\r\n{headers}\r\n",
        body.len()
    )
    .into_bytes();
    request.extend_from_slice(body);
    request
}

/// Response before the response, to a client that has closed its half of the connection.
pub const INTERIM: &[u8] = b"HTTP/1.1 100 Continue\r\n\r\n";

/// Reads an answer to its end.
pub fn read(stream: &mut TcpStream) -> CaseResponse {
    let mut bytes = Vec::new();
    // A server that refuses a body may close before it has read all of it.
    let _ = stream.read_to_end(&mut bytes);
    while let Some(rest) = bytes.strip_prefix(INTERIM) {
        bytes = rest.to_vec();
    }
    let split = bytes
        .windows(4)
        .position(|four| four == b"\r\n\r\n")
        .unwrap_or(bytes.len());
    let head = String::from_utf8_lossy(&bytes[..split]).to_lowercase();
    let status = head.split(' ').nth(1).and_then(|code| code.parse().ok());
    let rest = bytes.get(split + 4..).unwrap_or_default().to_vec();
    let body = match head.contains("transfer-encoding: chunked") {
        true => unchunked(&rest),
        false => rest,
    };
    CaseResponse {
        status: status.unwrap_or(0),
        head,
        body,
    }
}

fn unchunked(mut rest: &[u8]) -> Vec<u8> {
    let mut body = Vec::new();
    while let Some(end) = rest.windows(2).position(|two| two == b"\r\n") {
        let size = std::str::from_utf8(&rest[..end]).unwrap_or_default();
        let size = usize::from_str_radix(size, 16).unwrap_or(0);
        if size == 0 {
            break;
        }
        body.extend_from_slice(&rest[end + 2..end + 2 + size]);
        rest = &rest[end + 2 + size + 2..];
    }
    body
}

impl CaseResponse {
    pub fn text(&self) -> String {
        String::from_utf8_lossy(&self.body).into_owned()
    }

    pub fn json(&self) -> Value {
        serde_json::from_slice(&self.body).unwrap_or_else(|error| panic!("{error}: {self:?}"))
    }

    /// What is said to be wrong.
    pub fn problem(&self) -> String {
        let value = self.json();
        let message = value["problem"]["message"].as_str();
        message
            .unwrap_or_else(|| panic!("no problem in {self:?}"))
            .to_owned()
    }

    /// Lines of an answer that takes a while.
    pub fn lines(&self) -> Vec<Value> {
        let text = self.text();
        let lines = text.lines();
        lines
            .map(|line| serde_json::from_str(line).unwrap())
            .collect()
    }
}

/// The case of the seed paper.
pub const PAPER: &str = include_str!("../../../../cases/paper-table1/scenario.toml");
