//! All parts, as the host sees them: they get commands, and reply.

use crate::border::{Link, NAME, broken};
use crate::greeting::Greeting;
use crate::message::{Command, Reply, decode, encode};
use crate::shared::Shared;
use crate::transport::{Tag, Transport, TransportError};
use crate::worker::Worker;
use std::sync::Arc;
use xca_core::engine::EngineFailure;
use xca_core::{Engine, StartError};

/// All parts. The first one is the host's own.
pub(crate) struct Crew {
    own: Worker,
    link: Link,
    /// The failure that has stopped all parts.
    failure: Option<EngineFailure>,
}

impl Crew {
    /// Starts the own part, and waits until the others have started.
    pub(crate) fn start(
        engine: Arc<dyn Engine>,
        shared: &Shared,
        transport: Box<dyn Transport>,
    ) -> Result<Self, StartError> {
        let link = Link::new(transport);
        let other = |reason: String| StartError::Other { engine: NAME.to_owned(), reason };
        greet(shared, engine.name(), &link).map_err(|reason| {
            link.lock().end();
            other(reason)
        })?;
        let own = Worker::start(engine, shared, link.clone()).inspect_err(|_| link.lock().end())?;
        let mut crew = Self { own, link, failure: None };
        crew.replies(Reply::Done).map_err(|failure| other(failure.to_string()))?;
        Ok(crew)
    }

    /// Ends all parts.
    pub(crate) fn end(&self) {
        self.link.lock().end();
    }

    /// Stops all parts. Parts that wait for this one get an error.
    pub(crate) fn fail(&mut self, reason: String) -> EngineFailure {
        self.link.lock().end();
        self.failure.get_or_insert(broken(reason)).clone()
    }

    /// Sends each part its command, and returns the replies of all.
    pub(crate) fn ask(&mut self, commands: Vec<Command>) -> Result<Vec<Reply>, EngineFailure> {
        if let Some(failure) = &self.failure {
            return Err(failure.clone());
        }
        let mut commands = commands.into_iter().enumerate();
        let Some((_, own)) = commands.next() else { return Ok(Vec::new()) };
        for (part, command) in commands {
            let sent = encode(&command).and_then(|bytes| {
                self.link.lock().send(part, Tag::Command, bytes).map_err(|error| error.to_string())
            });
            if let Err(reason) = sent {
                return Err(self.fail(reason));
            }
        }
        let own = self.own.perform(own);
        self.replies(own)
    }

    /// Returns the replies of all parts, the own one first. If one part has failed, all stop.
    fn replies(&mut self, own: Reply) -> Result<Vec<Reply>, EngineFailure> {
        if matches!(own, Reply::Failed { .. }) {
            // Other parts may be waiting for this one.
            self.link.lock().end();
        }
        let count = self.link.lock().count();
        let mut replies = vec![own];
        let mut lost = None;
        for part in 1..count {
            let received: Result<Vec<u8>, TransportError> = self.link.lock().receive(part, Tag::Reply);
            let reply = received.map_err(|error| error.to_string()).and_then(|bytes| decode(&bytes));
            match reply {
                Ok(reply) => replies.push(reply),
                // A part that reports a reason takes precedence over a part that lost the connection.
                Err(reason) => {
                    lost.get_or_insert(reason);
                    replies.push(Reply::Elsewhere { done: 0 });
                }
            }
        }
        let failed = replies.iter().enumerate().find_map(|(part, reply)| match reply {
            Reply::Failed { reason } => Some(format!("part {part}: {reason}")),
            _ => None,
        });
        match failed.or(lost) {
            Some(reason) => Err(self.fail(reason)),
            None => Ok(replies),
        }
    }
}

/// Receives the greetings of the other parts. They start in the meantime.
fn greet(shared: &Shared, engine: &str, link: &Link) -> Result<(), String> {
    let own = Greeting::new(shared, engine);
    let count = link.lock().count();
    (1..count).try_for_each(|part| {
        let said = link.lock().receive(part, Tag::Reply).map_err(|error| error.to_string())?;
        own.check(part, &said)
    })
}
