//! Connections: how many, from whom, and for how long they may keep the server waiting.

#[cfg(test)]
#[path = "connection_tests.rs"]
mod tests;

use std::{
    collections::HashMap,
    io,
    net::IpAddr,
    pin::{Pin, pin},
    sync::{
        Arc, Mutex, MutexGuard, PoisonError,
        atomic::{AtomicBool, Ordering},
    },
    task::{Context, Poll},
    time::Duration,
};

use hyper::Version;
use tokio::{
    io::{AsyncRead, AsyncWrite, Interest, ReadBuf},
    net::TcpStream,
    sync::{Notify, OwnedSemaphorePermit, Semaphore},
    time::{Instant, Sleep, sleep, sleep_until},
};

use crate::limits::{CONNECTIONS, CONNECTIONS_OF_PEER, CONNECTIONS_WITHOUT_TOKEN};

/// Bytes that a client has to take per second of waiting for it, beyond its patience.
const LEAST_RATE: f64 = 16_384.0;
/// Time between two looks at whether a client is still there.
const LOOK: Duration = Duration::from_millis(200);
/// Interim response: of no meaning where nothing was asked for, and every client of HTTP/1.1 has to read over it.
const INTERIM: &[u8] = b"HTTP/1.1 100 Continue\r\n\r\n";

/// Places for connections.
#[derive(Debug, Clone)]
pub(crate) struct Places {
    all: Arc<Semaphore>,
    /// For connections that have not shown the token.
    unknown: Arc<Semaphore>,
    /// Connections of each peer that have not shown the token.
    peers: Arc<Mutex<HashMap<IpAddr, usize>>>,
    /// Told while somebody waits for a place.
    waiting: Arc<Notify>,
}

/// Place that nobody has yet.
#[derive(Debug)]
pub(crate) struct FreePlace {
    any: OwnedSemaphorePermit,
    unknown: OwnedSemaphorePermit,
}

/// Place of a connection, free again when this is dropped.
#[derive(Debug)]
pub(crate) struct Place {
    visitor: Visitor,
    waiting: Arc<Notify>,
    _any: OwnedSemaphorePermit,
}

/// Whether the client of a connection is known: it has shown the token, or none is needed.
#[derive(Debug, Clone)]
pub(crate) struct Visitor(Arc<Mutex<Option<Stranger>>>);

/// Place among the connections that have not shown the token.
#[derive(Debug)]
struct Stranger {
    peer: IpAddr,
    peers: Arc<Mutex<HashMap<IpAddr, usize>>>,
    _unknown: OwnedSemaphorePermit,
}

impl Places {
    pub(crate) fn new() -> Self {
        Self {
            all: Arc::new(Semaphore::new(CONNECTIONS)),
            unknown: Arc::new(Semaphore::new(CONNECTIONS_WITHOUT_TOKEN)),
            peers: Arc::default(),
            waiting: Arc::default(),
        }
    }

    /// Waits for a free place. Meanwhile connections that have had a response and ask for nothing give way: a client can open another one.
    pub(crate) async fn free(&self) -> Option<FreePlace> {
        let mut wanted = pin!(async {
            // The semaphores are never closed.
            Some(FreePlace {
                unknown: Arc::clone(&self.unknown).acquire_owned().await.ok()?,
                any: Arc::clone(&self.all).acquire_owned().await.ok()?,
            })
        });
        loop {
            tokio::select! {
                biased;
                free = &mut wanted => return free,
                () = sleep(LOOK) => self.waiting.notify_waiters(),
            }
        }
    }

    /// Gives a free place to a peer; none where its clients without the token have their share.
    pub(crate) fn give(&self, free: FreePlace, peer: IpAddr) -> Option<Place> {
        let mut peers = lock(&self.peers);
        let count = peers.entry(peer).or_default();
        // All programs of this machine have one address, and so has whoever comes through a proxy on it.
        if *count >= CONNECTIONS_OF_PEER && !peer.is_loopback() {
            return None;
        }
        *count += 1;
        let stranger = Stranger {
            peer,
            peers: Arc::clone(&self.peers),
            _unknown: free.unknown,
        };
        Some(Place {
            visitor: Visitor(Arc::new(Mutex::new(Some(stranger)))),
            waiting: Arc::clone(&self.waiting),
            _any: free.any,
        })
    }
}

impl Place {
    pub(crate) fn visitor(&self) -> Visitor {
        self.visitor.clone()
    }

    /// Ends when somebody waits for a place and this one's client has had a response.
    pub(crate) async fn is_wanted(&self, line: &Line) {
        loop {
            self.waiting.notified().await;
            if line.has_answered.load(Ordering::Relaxed) {
                return;
            }
        }
    }
}

impl Drop for Stranger {
    fn drop(&mut self) {
        let mut peers = lock(&self.peers);
        if let Some(count) = peers.get_mut(&self.peer) {
            *count -= 1;
            if *count == 0 {
                peers.remove(&self.peer);
            }
        }
    }
}

impl Visitor {
    /// The client is known from now on, and its place among the unknown is free.
    pub(crate) fn welcome(&self) {
        lock(&self.0).take();
    }

    pub(crate) fn is_known(&self) -> bool {
        lock(&self.0).is_none()
    }
}

fn lock<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    // What it guards is whole after every statement.
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

/// What a connection is at.
#[derive(Debug, Clone, Default)]
pub(crate) struct Line {
    /// A request is being computed, and nothing of its response is written.
    is_computing: Arc<AtomicBool>,
    /// The client does not take what is written.
    is_full: Arc<AtomicBool>,
    /// A request was answered.
    has_answered: Arc<AtomicBool>,
}

/// Request that is computed, until this is dropped.
pub(crate) struct Computing(Line);

impl Line {
    pub(crate) fn compute(&self, version: Version) -> Computing {
        // A client of HTTP/1.0 does not know interim responses.
        let knows = version >= Version::HTTP_11;
        self.is_computing.store(knows, Ordering::Relaxed);
        Computing(self.clone())
    }

    /// Ends when the client has closed the whole connection, not its own half alone. Both look the same until something is sent: whoever has
    /// closed the whole then refuses it. Polled by the task that writes responses, which it does not interrupt.
    pub(crate) async fn is_left(&self, stream: &TcpStream) {
        loop {
            sleep(LOOK).await;
            let Ok(ready) = stream.ready(Interest::READABLE | Interest::WRITABLE).await else {
                return;
            };
            if ready.is_write_closed() {
                return;
            }
            let is_silent =
                self.is_computing.load(Ordering::Relaxed) && !self.is_full.load(Ordering::Relaxed);
            if ready.is_read_closed() && is_silent {
                match stream.try_write(INTERIM) {
                    Ok(length) if length == INTERIM.len() => {}
                    Err(error) if error.kind() == io::ErrorKind::WouldBlock => {}
                    _ => return,
                }
            }
        }
    }
}

impl Drop for Computing {
    fn drop(&mut self) {
        self.0.is_computing.store(false, Ordering::Relaxed);
        self.0.has_answered.store(true, Ordering::Relaxed);
    }
}

/// Connection whose client has to take what it asked for: all the waiting for it is a patience and a second per [`LEAST_RATE`] bytes.
pub(crate) struct Patient<S> {
    stream: S,
    patience: Duration,
    /// Time that may still be waited.
    left: Duration,
    waiting: Option<(Instant, Pin<Box<Sleep>>)>,
    line: Line,
}

impl<S> Patient<S> {
    pub(crate) fn new(stream: S, patience: Duration, line: Line) -> Self {
        Self {
            stream,
            patience,
            left: patience,
            waiting: None,
            line,
        }
    }

    /// Ends the waiting after some bytes were written, or goes on with it.
    fn wait(
        &mut self,
        written: Poll<io::Result<usize>>,
        context: &mut Context<'_>,
    ) -> Poll<io::Result<usize>> {
        self.line
            .is_full
            .store(written.is_pending(), Ordering::Relaxed);
        match &written {
            Poll::Ready(result) => {
                if let Some((since, _)) = self.waiting.take() {
                    self.left = self.left.saturating_sub(since.elapsed());
                }
                let bytes = result.as_ref().map_or(0, |bytes| *bytes);
                let earned = Duration::from_secs_f64(bytes as f64 / LEAST_RATE);
                self.left = (self.left + earned).min(self.patience);
                written
            }
            Poll::Pending => {
                let left = self.left;
                let (_, end) = self.waiting.get_or_insert_with(|| {
                    let now = Instant::now();
                    (now, Box::pin(sleep_until(now + left)))
                });
                end.as_mut()
                    .poll(context)
                    .map(|()| Err(io::ErrorKind::TimedOut.into()))
            }
        }
    }
}

impl<S: AsyncRead + Unpin> AsyncRead for Patient<S> {
    fn poll_read(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        buffer: &mut ReadBuf<'_>,
    ) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_read(context, buffer)
    }
}

impl<S: AsyncWrite + Unpin> AsyncWrite for Patient<S> {
    fn poll_write(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        bytes: &[u8],
    ) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write(context, bytes);
        self.wait(written, context)
    }

    fn poll_write_vectored(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
        parts: &[io::IoSlice<'_>],
    ) -> Poll<io::Result<usize>> {
        let written = Pin::new(&mut self.stream).poll_write_vectored(context, parts);
        self.wait(written, context)
    }

    fn is_write_vectored(&self) -> bool {
        self.stream.is_write_vectored()
    }

    fn poll_flush(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_flush(context)
    }

    fn poll_shutdown(mut self: Pin<&mut Self>, context: &mut Context<'_>) -> Poll<io::Result<()>> {
        Pin::new(&mut self.stream).poll_shutdown(context)
    }
}
