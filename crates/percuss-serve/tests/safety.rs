//! Requests that no page of this server makes.

mod support;

use std::{
    io::{Read, Write},
    net::{IpAddr, Ipv4Addr, SocketAddr},
    thread,
    time::{Duration, Instant},
};

use percuss_serve::{Bounds, Options, ServeError, Server};
use serde_json::json;
use support::{PAPER, Served, post_request, read};

const TOKEN: &str = "correct-horse-battery-staple";

fn body() -> Vec<u8> {
    json!({ "case": PAPER, "model": "chain" })
        .to_string()
        .into_bytes()
}

#[test]
fn other_machines_are_let_in_on_request_and_with_a_token_only() {
    let remote = Options {
        address: SocketAddr::new(IpAddr::V4(Ipv4Addr::UNSPECIFIED), 0),
        ..Options::default()
    };
    let refused = Server::bind(remote.clone()).unwrap_err();
    assert!(matches!(refused, ServeError::Remote { .. }), "{refused}");
    let allowed = Options {
        allow_remote: true,
        ..remote
    };
    let refused = Server::bind(allowed.clone()).unwrap_err();
    assert!(matches!(refused, ServeError::NoToken { .. }), "{refused}");
    for token in [
        "",
        "short",
        "with a space in it, and long enough",
        "a\r\nSet-Cookie: b=c; d=e",
    ] {
        let refused = Server::bind(Options {
            token: Some(token.to_owned()),
            ..allowed.clone()
        });
        assert!(matches!(refused, Err(ServeError::Token { .. })), "{token}");
    }
    let options = Options {
        token: Some(TOKEN.to_owned()),
        ..allowed
    };
    assert!(Server::bind(options).is_ok());
}

#[test]
fn a_token_is_asked_for_everywhere() {
    let served = Served::new(Options {
        token: Some(TOKEN.to_owned()),
        ..Options::default()
    });
    for path in [
        "/",
        "/assets/app.js",
        "/materials",
        "/nothing",
        "/?token=wrong-token-of-any-size",
    ] {
        assert_eq!(served.get(path, "").status, 401, "{path}");
    }
    assert_eq!(served.post_bytes("/api/answer", &body(), "").status, 401);
    let query = format!("/api/answer?token={TOKEN}");
    assert_eq!(served.post_bytes(&query, &body(), "").status, 401);

    let first = served.get(&format!("/?token={TOKEN}"), "");
    assert_eq!(first.status, 303);
    assert!(first.head.contains("location: /\r\n"), "{}", first.head);
    assert!(first.head.contains("httponly; samesite=strict"));
    assert!(
        served
            .get(&format!("//elsewhere.example/?token={TOKEN}"), "")
            .head
            .contains("location: /elsewhere")
    );
    let cookie = format!("Cookie: other=1; percuss_token={TOKEN}\r\n");
    assert_eq!(served.get("/", &cookie).status, 200);
    assert_eq!(
        served.post_bytes("/api/answer", &body(), &cookie).status,
        200
    );
    let bearer = format!("Authorization: Bearer {TOKEN}\r\n");
    assert_eq!(served.get("/", &bearer).status, 200);
    assert_eq!(
        served
            .get("/", "Authorization: Bearer correct-horse-battery-stapl\r\n")
            .status,
        401
    );
}

#[test]
fn a_name_that_is_not_the_servers_is_refused() {
    let served = Served::new(Options {
        host_names: vec!["Bench.example".to_owned()],
        ..Options::default()
    });
    let port = served.address.port();
    let get = |host: &str| {
        let request = format!("GET / HTTP/1.1\r\n{host}Connection: close\r\n\r\n");
        served.raw(request.as_bytes()).status
    };
    // By DNS rebinding a name of an attacker leads to this machine.
    for host in [
        format!("Host: attacker.example:{port}\r\n"),
        format!("Host: localhost.attacker.example:{port}\r\n"),
        format!("Host: 127.0.0.1.attacker.example:{port}\r\n"),
        format!("Host: 192.168.1.7:{port}\r\n"),
        format!("Host: localhost@attacker.example:{port}\r\n"),
        format!("Host: attacker.example@localhost:{port}\r\n"),
        "Host: \r\n".to_owned(),
        "Host: \u{fc}\r\n".to_owned(),
        String::new(),
        format!("Host: localhost:{port}\r\nHost: attacker.example\r\n"),
    ] {
        let status = get(&host);
        assert!(matches!(status, 400 | 421), "{host}: {status}");
    }
    for host in [
        "localhost",
        "LOCALHOST:1",
        "127.0.0.1",
        "[::1]:80",
        "bench.example",
    ] {
        assert_eq!(get(&format!("Host: {host}\r\n")), 200, "{host}");
    }
    let absolute = format!(
        "GET http://attacker.example/ HTTP/1.1\r\nHost: localhost:{port}\r\nConnection: close\r\n\r\n"
    );
    assert_eq!(served.raw(absolute.as_bytes()).status, 421);
}

#[test]
fn pages_of_other_sites_are_refused() {
    let served = Served::new(Options::default());
    let own = served.address;
    for headers in [
        "Origin: https://attacker.example\r\n".to_owned(),
        "Origin: null\r\n".to_owned(),
        "Origin: http://localhost:1\r\n".to_owned(),
        format!("Origin: http://{own}.attacker.example\r\n"),
        format!("Origin: http://{own}\r\nOrigin: https://attacker.example\r\n"),
        "Sec-Fetch-Site: cross-site\r\n".to_owned(),
        "Sec-Fetch-Site: same-site\r\n".to_owned(),
    ] {
        let answer = served.post_bytes("/api/answer", &body(), &headers);
        assert_eq!(answer.status, 403, "{headers}");
        assert!(!answer.head.contains("access-control-allow"), "{headers}");
    }
    let headers = format!("Origin: http://{own}\r\nSec-Fetch-Site: same-origin\r\n");
    assert_eq!(
        served.post_bytes("/api/answer", &body(), &headers).status,
        200
    );
    // What a form of another site can send without asking.
    for kind in [
        "text/plain",
        "application/x-www-form-urlencoded",
        "multipart/form-data",
    ] {
        let request = String::from_utf8(post_request(own, "/api/answer", &body(), "")).unwrap();
        let request = request.replace("application/json", kind);
        assert_eq!(served.raw(request.as_bytes()).status, 415, "{kind}");
    }
    let preflight = format!(
        "OPTIONS /api/answer HTTP/1.1\r\nHost: {own}\r\nOrigin: https://attacker.example\r\nAccess-Control-Request-Method: POST\r\nConnection: close\r\n\r\n"
    );
    assert_eq!(served.raw(preflight.as_bytes()).status, 403);
}

#[test]
fn every_answer_has_its_policy() {
    let served = Served::new(Options::default());
    for path in [
        "/",
        "/assets/app.js",
        "/materials",
        "/materials/copper",
        "/nothing",
    ] {
        let head = served.get(path, "").head;
        for header in [
            "content-security-policy: default-src 'none'",
            "x-content-type-options: nosniff",
            "referrer-policy: no-referrer",
        ] {
            assert!(head.contains(header), "{path}: {head}");
        }
        assert!(!head.contains("script-src 'unsafe"), "{path}");
    }
    assert!(served.get("/", "").head.contains("script-src 'self'"));
    assert!(!served.get("/", "").head.contains("unsafe-inline"));
    assert!(!served.get("/materials", "").head.contains("script-src"));
}

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
        assert!(
            answer
                .problem()
                .starts_with("the request is not understood")
        );
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
    assert_eq!(answer.status, 400);
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
    assert!(start.elapsed() < Duration::from_secs(30));
    assert_eq!(served.get("/", "").status, 200);
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

#[test]
fn a_case_cannot_ask_for_too_much() {
    let served = Served::new(Options {
        bounds: Bounds {
            elements: 200,
            seconds: 1,
            ..Bounds::default()
        },
        ..Options::default()
    });
    let fine = PAPER.replace("target_elements = 80", "target_elements = 4000");
    let answer = served.post("/api/answer", &json!({ "case": fine, "model": "chain" }));
    assert_eq!(answer.status, 422);
    assert_eq!(answer.problem(), "the mesh has 4040 elements");
    let answer = served.post("/api/answer", &json!({ "case": fine, "model": "fdm" }));
    assert_eq!(answer.status, 422);
    // Three refinements of 40 and 80 elements are more than 200.
    let lines = served
        .post(
            "/api/study/converge",
            &json!({ "case": PAPER, "model": "chain" }),
        )
        .lines();
    assert_eq!(lines[0]["problem"]["message"], "the mesh has 960 elements");
    let layers = "{ material = \"copper\", thickness = \"1 mm\" },".repeat(500);
    let layered = format!(
        "projectile = {{ material = \"copper\", length = \"10 mm\", diameter = \"5 mm\", velocity = \"300 m/s\" }}\ntarget.layers = [{layers}]"
    );
    assert_eq!(
        served
            .post("/api/answer", &json!({ "case": layered, "model": "chain" }))
            .status,
        422
    );
    let answer = served.post("/api/answer", &json!({ "case": PAPER, "model": "axi" }));
    assert_eq!(answer.status, 400, "{}", answer.text());
    let lines = served
        .post("/api/study/run", &json!({ "case": PAPER, "model": "axi" }))
        .lines();
    let last = &lines[lines.len() - 1]["problem"]["message"];
    assert_eq!(last, "the run was ended after 1 s");
    for speeds in [
        json!([0.0, 1e5, 10]),
        json!([0.0, 100.0, 1_000_000]),
        json!([-1.0, 100.0, 3]),
    ] {
        let lines = served
            .post(
                "/api/study/compare",
                &json!({ "case": PAPER, "speeds": speeds }),
            )
            .lines();
        assert!(lines[0]["problem"]["message"].is_string(), "{lines:?}");
    }
}

#[test]
fn runs_have_places_and_free_them_when_nobody_waits() {
    let served = Served::new(Options {
        bounds: Bounds {
            runs: 1,
            ..Bounds::default()
        },
        ..Options::default()
    });
    let long = json!({ "case": PAPER, "model": "axi" }).to_string();
    let request = post_request(served.address, "/api/study/run", long.as_bytes(), "");
    let mut waiting = served.connect();
    waiting.write_all(&request).unwrap();
    // What it says of its progress shows that the run has its place.
    let mut said = Vec::new();
    while !String::from_utf8_lossy(&said).contains("progress") {
        let mut some = [0; 512];
        let count = waiting.read(&mut some).unwrap();
        assert!(count > 0, "{}", String::from_utf8_lossy(&said));
        said.extend_from_slice(&some[..count]);
    }
    let busy = served.post_bytes("/api/answer", &body(), "");
    assert_eq!(busy.status, 503);
    assert_eq!(busy.problem(), "1 runs are under way, the most at a time");
    // Who goes away cancels: the place is free long before the run would have ended.
    drop(waiting);
    let start = Instant::now();
    while served.post_bytes("/api/answer", &body(), "").status != 200 {
        assert!(start.elapsed() < Duration::from_secs(15));
    }
}

#[test]
fn an_answer_that_nobody_waits_for_is_not_computed_to_its_end() {
    let served = Served::new(Options {
        bounds: Bounds {
            runs: 1,
            elements: 20_000,
            seconds: 600,
        },
        ..Options::default()
    });
    let fine = PAPER.replace("= 40", "= 4000").replace("= 80", "= 8000");
    let long = json!({ "case": fine, "model": "chain" }).to_string();
    let mut waiting = served.connect();
    waiting
        .write_all(&post_request(
            served.address,
            "/api/answer",
            long.as_bytes(),
            "",
        ))
        .unwrap();
    thread::sleep(Duration::from_millis(500));
    drop(waiting);
    let start = Instant::now();
    while served.post_bytes("/api/answer", &body(), "").status != 200 {
        assert!(start.elapsed() < Duration::from_secs(30));
    }
}
