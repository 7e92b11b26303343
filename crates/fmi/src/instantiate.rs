//! A new instance: whether what the master passes fits the binary.

use crate::failure::Failure;
use crate::identity::guid_of;
use crate::instance::{Instance, Interface};
use crate::model::{FromResources, Model, Resources};
use std::path::{Path, PathBuf};

/// What a master passes for a new instance.
#[derive(Debug)]
pub struct Request<'a> {
    /// Name of the instance.
    pub name: &'a str,
    /// What it is for.
    pub interface: Interface,
    /// Name of the argument that holds the token: `fmuGUID`, `instantiationToken`.
    pub token_argument: &'static str,
    /// GUID or instantiation token of the model description.
    pub token: &'a str,
    /// Folder of the package's resources, if the master says where; read as
    /// [`Model::RESOURCES`] says.
    pub resources: Option<PathBuf>,
    /// Whether debug messages are wanted.
    pub logging_on: bool,
}

/// Why there is no new instance.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum NotInstantiated {
    /// Every instance has a name.
    #[error("the instance name must not be empty")]
    NoName,
    /// Model description and binary do not belong together.
    #[error(
        "{argument} is {given}, but this binary has {own}: model description and binary are not \
         from the same FMU"
    )]
    Token {
        /// Name of the argument.
        argument: &'static str,
        /// The refused token.
        given: String,
        /// The token of the built-in data.
        own: String,
    },
    /// The token is not that of the built-in data, and the resources cannot be read.
    #[error("{argument} is {given}, not that of the built-in data, {own}, and {problem}")]
    Resources {
        /// Name of the argument.
        argument: &'static str,
        /// The token.
        given: String,
        /// The token of the built-in data.
        own: String,
        /// Which file and key, the limit, and what to do.
        problem: String,
    },
    /// The resources cannot be read.
    #[error("{problem}")]
    Data {
        /// Which file and key, the limit, and what to do.
        problem: String,
    },
    /// The model has no defaults, or not this interface.
    #[error(transparent)]
    Model(#[from] Failure),
}

impl<M: Model> Instance<M> {
    /// `fmi2Instantiate` and its like: the built-in model, or that of the package's resources, see
    /// [`Resources`].
    ///
    /// # Errors
    /// [`NotInstantiated`].
    pub fn instantiate(request: Request) -> Result<Self, NotInstantiated> {
        let Request { name, interface, token_argument: argument, token, .. } = request;
        if name.trim().is_empty() {
            return Err(NotInstantiated::NoName);
        }
        let own = guid_of(M::IDENTITY);
        let (given, resources) = (token.to_string(), request.resources.as_deref());
        let model = match (M::RESOURCES, token == own) {
            (Resources::Replaceable(read), true) => match resources {
                Some(folder) => read(folder)
                    .map_err(|error| NotInstantiated::Data { problem: error.to_string() })?,
                None => M::new().map_err(Failure::from)?,
            },
            (_, true) => M::new().map_err(Failure::from)?,
            (Resources::Identified(read), false) => from_resources(read, resources, token)
                .map_err(|problem| NotInstantiated::Resources { argument, given, own, problem })?,
            (_, false) => return Err(NotInstantiated::Token { argument, given, own }),
        };
        Ok(Self::of(model, interface, request.logging_on)?)
    }
}

fn from_resources<M: Model>(
    read: FromResources<M>,
    resources: Option<&Path>,
    token: &str,
) -> Result<M, String> {
    let folder = resources.ok_or("the master does not say where the resources are")?;
    let model = read(folder).map_err(|error| error.to_string())?;
    let theirs = guid_of(model.identity());
    if theirs == token {
        return Ok(model);
    }
    Err(format!(
        "the data in {} belong to {theirs}: model description and data are not from the same FMU",
        folder.to_string_lossy()
    ))
}
