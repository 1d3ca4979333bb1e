//! Requests that are not what they should be.

use std::{
    io::Write,
    net::Shutdown,
    time::{Duration, Instant},
};

use percuss_serve::{Options, RequestLimits};
use serde_json::json;

use crate::{
    body,
    support::{PAPER, Served, post_request, read},
};

#[test]
fn bodies_have_a_size_and_a_form() {
    let served = Served::new(Options::default());
    let huge = vec![b' '; 1 << 20];
    assert_eq!(served.post_bytes("/api/answer", &huge, "").status, 413);
    // One that does not say how long it is.
    let mut chunked = format!(
        "POST /api/answer HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Type: application/json\r\nTransfer-Encoding: chunked\r\n\r\n",
        served.address
    )
    .into_bytes();
    for _ in 0..40 {
        chunked.extend_from_slice(b"4000\r\n");
        chunked.extend_from_slice(&[b' '; 0x4000]);
        chunked.extend_from_slice(b"\r\n");
    }
    chunked.extend_from_slice(b"0\r\n\r\n");
    assert_eq!(served.raw(&chunked).status, 413);
    // A length that is none.
    let place = chunked.windows(6).position(|part| part == b"4000\r\n");
    chunked.truncate(place.unwrap());
    chunked.extend_from_slice(b"zz\r\n{}\r\n0\r\n\r\n");
    let broken = served.raw(&chunked);
    assert_eq!(broken.status, 400, "{}", broken.text());
    let deep = "[".repeat(100_000);
    let nested = format!("{{\"case\":{deep}");
    for bad in [
        &b""[..],
        b"{",
        b"null",
        b"[]",
        b"{\"case\": 1}",
        b"{\"case\": \"\xff\xfe\"}",
        b"{\"case\": \"\\ud800\"}",
        b"{\"case\": \"\", \"file_path\": \"/etc/passwd\"}",
        b"{\"case\": \"\", \"edits\": [{\"key\": \"a\", \"value\": NaN}]}",
        nested.as_bytes(),
    ] {
        let answer = served.post_bytes("/api/answer", bad, "");
        assert_eq!(
            answer.status,
            400,
            "{:?}",
            String::from_utf8_lossy(&bad[..bad.len().min(40)])
        );
        assert!(answer.problem().starts_with("the request is not valid"));
    }
    // The same in the case itself.
    for case in [
        format!("a = {deep}"),
        "a.".repeat(30_000),
        "\u{0}".to_owned(),
        format!("a = {}", "{b=".repeat(30_000)),
    ] {
        let answer = served.post(
            "/api/answer",
            &json!({ "case": case, "edits": [{ "key": "a.b", "value": "1" }] }),
        );
        assert_eq!(answer.status, 422, "{}", answer.text());
    }
    let key = "a.".repeat(30_000) + "a";
    let answer = served.post(
        "/api/answer",
        &json!({ "case": PAPER, "edits": [{ "key": key, "value": "1" }] }),
    );
    assert_eq!(answer.status, 400);
    let value = "[".repeat(30_000);
    let answer = served.post(
        "/api/answer",
        &json!({ "case": PAPER, "edits": [{ "key": "a", "value": value }] }),
    );
    assert_eq!(answer.status, 422);
    assert_eq!(answer.json()["problem"]["key"], "a");
    assert_eq!(served.post_bytes("/api/answer", &body(), "").status, 200);
}

#[test]
fn who_is_slow_is_not_waited_for() {
    let served = Served::new(Options::default());
    let whole = post_request(served.address, "/api/answer", &body(), "");
    let mut in_body = served.connect();
    in_body.write_all(&whole[..whole.len() - 10]).unwrap();
    let mut in_head = served.connect();
    in_head.write_all(b"GET / HTTP/1.1\r\nHost: loc").unwrap();
    let start = Instant::now();
    assert_eq!(read(&mut in_body).status, 408);
    let answer = read(&mut in_head);
    assert!(matches!(answer.status, 0 | 408), "{answer:?}");
    assert!(start.elapsed() < Duration::from_secs(60));
    assert_eq!(served.get("/", "").status, 200);
}

/// Whoever has sent its request may close its half of the connection: it still waits, however long the run takes.
#[test]
fn who_closes_its_half_is_answered() {
    let served = Served::new(Options {
        bounds: RequestLimits {
            elements: 20_000,
            ..RequestLimits::default()
        },
        ..Options::default()
    });
    let host = served.address;
    let keep = |request: &[u8]| {
        let text = String::from_utf8(request.to_vec()).unwrap();
        text.replace("Connection: close\r\n", "").into_bytes()
    };
    let post = |path: &str, body: &[u8]| post_request(host, path, body, "");
    let fine = PAPER.replace("= 40", "= 1000").replace("= 80", "= 2000");
    let fine = json!({ "case": fine, "model": "chain" }).to_string();
    let page = format!("GET / HTTP/1.1\r\nHost: {host}\r\n\r\n").into_bytes();
    let old = keep(&post("/api/answer", &body()));
    let old = String::from_utf8(old)
        .unwrap()
        .replace("HTTP/1.1", "HTTP/1.0");
    for (request, length) in [
        (page.clone(), 1),
        (page.repeat(3), 1),
        (post("/api/answer", &body()), 1),
        (keep(&post("/api/answer", &body())), 1),
        (old.into_bytes(), 1),
        (post("/api/study/compare", &body()), 2),
        (post("/api/answer", fine.as_bytes()), 1),
    ] {
        let mut stream = served.connect();
        stream.write_all(&request).unwrap();
        stream.shutdown(Shutdown::Write).unwrap();
        let start = Instant::now();
        let answer = read(&mut stream);
        println!("{} bytes after {:?}", answer.body.len(), start.elapsed());
        assert_eq!(answer.status, 200, "{}", String::from_utf8_lossy(&request));
        match length {
            2 => assert!(answer.lines().pop().unwrap()["done"].is_object()),
            _ => assert!(answer.body.len() > 10_000),
        }
        assert!(start.elapsed() < Duration::from_secs(100));
    }
}

#[test]
fn nothing_but_the_programs_own_is_served() {
    let served = Served::new(Options::default());
    for path in [
        "/assets/../../Cargo.toml",
        "/assets/..%2f..%2fCargo.toml",
        "/assets/%2e%2e/%2e%2e/Cargo.toml",
        "/assets//etc/passwd",
        "/assets/..\\..\\Cargo.toml",
        "/assets/index.html",
        "/assets/%00app.js",
        "/assets/%ff.js",
        "/materials/..%2f..%2fetc%2fpasswd",
        "/etc/passwd",
        "/.git/config",
        "/api/answer",
    ] {
        let answer = served.get(path, "");
        assert!(
            matches!(answer.status, 400 | 404 | 405),
            "{path}: {}",
            answer.status
        );
        assert!(!answer.text().contains("[package]") && !answer.text().contains("root:"));
    }
    for garbage in [
        &b"\x16\x03\x01\x02\x00\x01\x00"[..],
        b"GET\r\n\r\n",
        b"\r\n\r\n\r\n",
        b"GET / HTTP/9.9\r\n\r\n",
    ] {
        let status = served.raw(garbage).status;
        assert!(matches!(status, 0 | 400 | 505), "{status}");
    }
    assert_eq!(served.get("/", "").status, 200);
}
