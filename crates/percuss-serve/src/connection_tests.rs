use std::future::poll_fn;

use tokio::{runtime::Builder, time};

use super::*;

const ONE: IpAddr = IpAddr::V4(std::net::Ipv4Addr::new(10, 0, 0, 1));
const OTHER: IpAddr = IpAddr::V4(std::net::Ipv4Addr::new(10, 0, 0, 2));

fn given(places: &Places, peer: IpAddr) -> Option<Place> {
    let free = FreePlace {
        unknown: Arc::clone(&places.unknown).try_acquire_owned().ok()?,
        any: Arc::clone(&places.all).try_acquire_owned().ok()?,
    };
    places.give(free, peer)
}

#[test]
fn a_peer_has_its_share_and_no_more() {
    let places = Places::new();
    let mut held: Vec<Place> = std::iter::from_fn(|| given(&places, ONE)).collect();
    assert_eq!(held.len(), CONNECTIONS_OF_PEER);
    assert!(given(&places, OTHER).is_some());
    held.pop();
    held.push(given(&places, ONE).expect("a place is free again"));
    assert!(given(&places, ONE).is_none());
    // A client that has shown the token no longer counts.
    held[0].visitor().welcome();
    held.push(given(&places, ONE).expect("a known client does not count"));
    drop(held);
    assert!(lock(&places.peers).is_empty());
    assert_eq!(places.all.available_permits(), CONNECTIONS);
    assert_eq!(
        places.unknown.available_permits(),
        CONNECTIONS_WITHOUT_TOKEN
    );
}

/// Many clients of this machine, and those of a proxy, have one address.
#[test]
fn this_machine_has_all_places() {
    let places = Places::new();
    let held: Vec<Place> = std::iter::from_fn(|| {
        let place = given(&places, IpAddr::V4(std::net::Ipv4Addr::LOCALHOST))?;
        place.visitor().welcome();
        Some(place)
    })
    .collect();
    assert_eq!(held.len(), CONNECTIONS);
}

/// Clients without the token cannot take all places; a known client gives its place among them back.
#[test]
fn places_are_kept_for_known_clients() {
    let places = Places::new();
    let peer = |k: usize| IpAddr::V4(std::net::Ipv4Addr::from(0x0a00_0000 + k as u32));
    let held: Vec<Place> = (0..CONNECTIONS)
        .map_while(|k| given(&places, peer(k)))
        .collect();
    assert_eq!(held.len(), CONNECTIONS_WITHOUT_TOKEN);
    assert!(!held[0].visitor().is_known());
    held[0].visitor().welcome();
    assert!(held[0].visitor().is_known());
    assert!(given(&places, peer(CONNECTIONS)).is_some());
}

/// Client that takes bytes at a rate, as often as every hundredth of a second.
struct Reader {
    rate: f64,
    last: Instant,
    sleep: Pin<Box<Sleep>>,
}

impl AsyncWrite for Reader {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        std::task::ready!(self.sleep.as_mut().poll(context));
        let now = Instant::now();
        self.sleep.as_mut().reset(now + Duration::from_millis(10));
        let due = (self.rate * (now - self.last).as_secs_f64()) as usize;
        if due == 0 {
            context.waker().wake_by_ref();
            return Poll::Pending;
        }
        self.last = now;
        Poll::Ready(Ok(due.min(bytes.len())))
    }

    fn poll_flush(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }

    fn poll_shutdown(self: Pin<&mut Self>, _: &mut Context<'_>) -> Poll<io::Result<()>> {
        Poll::Ready(Ok(()))
    }
}

/// Sends 64 KiB to a client that reads at a rate [bytes/s], with a patience of half a second.
fn sent(rate: f64) -> io::Result<usize> {
    let builder = Builder::new_current_thread().enable_time().build();
    builder.unwrap().block_on(async {
        let reader = Reader {
            rate,
            last: Instant::now(),
            sleep: Box::pin(time::sleep(Duration::ZERO)),
        };
        let mut patient = Patient::new(reader, Duration::from_millis(500), Line::default());
        let bytes = [0; 1 << 16];
        let mut sent = 0;
        while sent < bytes.len() {
            sent += poll_fn(|context| Pin::new(&mut patient).poll_write(context, &bytes[sent..]))
                .await?;
        }
        Ok(sent)
    })
}

#[test]
fn a_client_has_to_read_at_a_least_rate() {
    for rate in [0.0, 10.0, 0.5 * LEAST_RATE] {
        let error = sent(rate).unwrap_err();
        assert_eq!(error.kind(), io::ErrorKind::TimedOut, "{rate}");
    }
    assert_eq!(sent(4.0 * LEAST_RATE).unwrap(), 1 << 16);
}
