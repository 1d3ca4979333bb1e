use super::*;

#[test]
fn sizes_have_the_largest_unit() {
    let of = [0, 1023, 1024, 1 << 20, 3 << 29, 1 << 34].map(size);
    assert_eq!(
        of,
        [
            "0 bytes",
            "1023 bytes",
            "1 KiB",
            "1 MiB",
            "1.5 GiB",
            "16 GiB"
        ]
    );
}

#[test]
fn a_file_of_just_the_limit_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.txt");
    std::fs::write(&path, "12345").unwrap();
    assert_eq!(text(&path, 5).unwrap(), "12345");
    let error = text(&path, 4).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::FileTooLarge);
    assert_eq!(
        error.to_string(),
        "it is larger than 4 bytes, the limit for such a file"
    );
    std::fs::write(&path, b"ab\nc\xff").unwrap();
    let error = text(&path, 5).unwrap_err();
    assert_eq!(error.to_string(), "byte 4 in line 2 is not UTF-8 text");
}

#[cfg(unix)]
#[test]
fn pipes_devices_and_links_to_them_are_refused_at_once() {
    let folder = tempfile::tempdir().unwrap();
    let [pipe, link, folder_link] = ["pipe", "link", "here"].map(|name| folder.path().join(name));
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    std::os::unix::fs::symlink("/dev/zero", &link).unwrap();
    std::os::unix::fs::symlink(folder.path(), &folder_link).unwrap();
    for path in [&pipe, &link, Path::new("/dev/zero")] {
        let error = bytes(path, 10).unwrap_err();
        assert_eq!(error.to_string(), "it is not a regular file", "{path:?}");
    }
    let error = bytes(&folder_link, 10).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::IsADirectory);
    let words = unreadable(&folder.path().join("none"), error_of("none")).to_string();
    assert!(words.contains("there is no such file"), "{words}");
}

/// A pipe without a writer may take the place of a file between the two checks.
#[cfg(unix)]
#[test]
fn opening_does_not_wait() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let (sent, received) = std::sync::mpsc::channel();
    std::thread::spawn(move || sent.send(options().open(pipe).unwrap()).unwrap());
    let opened = received.recv_timeout(std::time::Duration::from_secs(20));
    let error = regular(&opened.unwrap().metadata().unwrap(), 10).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::InvalidInput);
}

#[cfg(unix)]
fn error_of(name: &str) -> io::Error {
    bytes(Path::new(name), 10).unwrap_err()
}
