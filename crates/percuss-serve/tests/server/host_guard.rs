//! Who is let in, and what every answer says to a browser.

use std::net::{IpAddr, Ipv4Addr, SocketAddr};

use percuss_serve::{Options, ServeError, Server};

use crate::{
    body,
    support::{Served, post_request},
};

const TOKEN: &str = "correct-horse-battery-staple";

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
    let slash = served.get(&format!("/\\elsewhere.example/?token={TOKEN}"), "");
    assert!(!slash.head.contains("location: /\\"), "{}", slash.head);
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
    for path in ["/", "/materials"] {
        let head = served.get(path, "").head;
        assert!(head.contains("script-src 'self'"), "{path}: {head}");
        assert!(!head.contains("unsafe-inline"), "{path}: {head}");
    }
    let card = served.get("/materials/copper", "").head;
    assert!(!card.contains("script-src"), "{card}");
}
