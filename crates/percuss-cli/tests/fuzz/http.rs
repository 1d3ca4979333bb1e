//! Requests of HTTP to a server of this process.

use std::{
    io::{Read, Write},
    net::{Shutdown, SocketAddr, TcpStream},
    sync::LazyLock,
    thread,
    time::Duration,
};

use percuss_serve::{Options, RequestLimits, Server};

use super::targets::{BROKEN, End};

/// Waiting for a response. The server ends a run after five seconds.
const PATIENCE: Duration = Duration::from_secs(25);
/// Longest response to a request that is refused, beside the text of the case [bytes].
const LONGEST_REFUSAL: usize = 20_000;

static ADDRESS: LazyLock<SocketAddr> = LazyLock::new(|| {
    let server = Server::bind(Options {
        bounds: RequestLimits {
            seconds: 5,
            ..RequestLimits::default()
        },
        ..Options::default()
    });
    let server = server.expect("the server starts");
    let address = server.address();
    thread::spawn(move || server.run());
    address
});

/// Requests, with lines that end as in Unix and `auto` for the length of the body.
pub fn seeds() -> Vec<String> {
    let post = |path: &str, body: &str| {
        format!(
            "POST {path} HTTP/1.1\nHost: localhost\nConnection: close\nContent-Type: application/json\nContent-Length: auto\n\n{body}"
        )
    };
    let case = crate::support::CASE
        .replace('"', "\\\"")
        .replace('\n', "\\n");
    let asked = |more: &str| format!("{{\"name\":\"rod\",\"case\":\"{case}\"{more}}}");
    let get = |path: &str| {
        format!(
            "GET {path} HTTP/1.1\nHost: localhost\nConnection: close\nAccept: */*\nCookie: percuss_token=a\n\n"
        )
    };
    let chunked = "POST /api/answer HTTP/1.1\nHost: localhost\nConnection: close\nContent-Type: application/json\nTransfer-Encoding: chunked\n\n2\r\n{}\r\n0\r\n\r\n";
    vec![
        post("/api/answer", &asked(",\"model\":\"crater_energy\"")),
        post("/api/answer", &asked(",\"model\":\"chain\"")),
        post(
            "/api/file",
            &asked(",\"model\":\"crater_energy\",\"file\":\"result.json\""),
        ),
        post("/api/study/compare", &asked(",\"speeds\":[100.0,200.0,2]")),
        post("/api/study/sweep", &asked(",\"sweep\":\"samples = 2\"")),
        post("/api/uncertainty-example", &asked("")),
        get("/"),
        get("/materials/copper"),
        get("/assets/page.js"),
        chunked.to_owned(),
    ]
}

/// A request gets a whole response, or none where it is none itself.
pub fn request(input: &[u8]) -> End {
    let response = sent(&in_wire_format(input));
    match crate::support::status(&response) {
        500 => Err(format!("{BROKEN}{}", String::from_utf8_lossy(&response))),
        400.. if response.len() > LONGEST_REFUSAL + 2 * input.len() => {
            Err(format!("{BROKEN}a refusal of {} bytes", response.len()))
        }
        0 => Ok("closed"),
        100..400 => Ok("answered"),
        _ => Ok("refused"),
    }
}

/// Lines of the head end with both characters; `auto` is the length of the body.
fn in_wire_format(input: &[u8]) -> Vec<u8> {
    let end = input.windows(2).position(|pair| pair == b"\n\n");
    let (head, body) = input.split_at(end.map_or(input.len(), |end| end + 2));
    let mut request = Vec::new();
    for line in head.split_inclusive(|byte| *byte == b'\n') {
        match line.strip_suffix(b"\n") {
            Some(b"Content-Length: auto") => {
                request.extend_from_slice(format!("Content-Length: {}\r\n", body.len()).as_bytes());
            }
            Some(line) => request.extend([line, b"\r\n"].concat()),
            None => request.extend_from_slice(line),
        }
    }
    request.extend_from_slice(body);
    request
}

fn sent(request: &[u8]) -> Vec<u8> {
    let mut stream = TcpStream::connect(*ADDRESS).expect("the server listens");
    stream
        .set_read_timeout(Some(PATIENCE))
        .expect("a time limit is set");
    // A server may refuse a request before it has read all of it. A length that was changed is not waited for.
    let _ = stream.write_all(request);
    let _ = stream.shutdown(Shutdown::Write);
    let mut response = Vec::new();
    let _ = stream.read_to_end(&mut response);
    response
}
