//! A process on the device: its shader, compiled, and what it is bound to.

use crate::device::{Access, Binding, Bindings, Buffer, Code, Corrections, Device, DeviceError, Pipeline};
use crate::error::NotOnDevice;
use crate::groups::{Group, Groups};
use crate::service;
use crate::space::{Section, Space};
use crate::values;
use std::collections::HashMap;
use std::num::NonZeroU32;
use std::sync::{Arc, Mutex, PoisonError};
use xca_core::engine::SubstateId;
use xca_core::{Model, ParameterSet, Parity, Precision, Process, ProcessKind, Stream};
use xca_wgsl::{BindingAccess, Content, Dispatch, Layout, Numbering, Options, Shader, State};

/// How processes are compiled.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Manner {
    pub(crate) precision: Precision,
    /// Where the driver must not change float arithmetic: which operations are corrected.
    pub(crate) strict: Option<Corrections>,
    /// The invocations of a workgroup, a power of two.
    pub(crate) workgroup: u32,
    /// The most bytes of a substate of cells that a process reaches at once.
    pub(crate) reach: u64,
}

/// A compiled process.
#[derive(Debug)]
pub(crate) struct Program {
    pub(crate) process: Process,
    /// Of its random numbers.
    stream: Stream,
    pub(crate) shader: Shader,
    pipeline: Arc<Pipeline>,
    parameters: Vec<Parameters>,
    /// The description of the space for each section.
    spaces: Option<(Layout, Vec<Buffer>)>,
    offsets: Option<Buffer>,
    directions: Option<Buffer>,
    /// Where it notes what it changes, if it does.
    notes: Option<Binding>,
    /// Bound pipelines by the buffers that they are bound to.
    bound: HashMap<Vec<(u64, u64)>, Bindings>,
}

/// A struct of parameters on the device.
#[derive(Debug)]
struct Parameters {
    /// The number of the struct among those of parameters that the process takes.
    argument: usize,
    layout: Layout,
    buffer: Buffer,
}

/// The texts of processes that were written already: many runs of one program need the same ones.
#[derive(Debug, Default)]
pub(crate) struct Texts(Mutex<HashMap<(usize, Options), Shader>>);

impl Texts {
    fn of(&self, process: &Process, options: Options) -> Result<Shader, xca_wgsl::Error> {
        // Two processes have the same body only where they are the same.
        let key = (process.body as usize, options);
        let known = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(shader) = known().get(&key) {
            return Ok(shader.clone());
        }
        let shader = xca_wgsl::shader(&(process.body)(), &key.1)?;
        Ok(known().entry(key).or_insert(shader).clone())
    }
}

/// The text of a process for a model.
pub(crate) fn shader_of(
    texts: &Texts,
    model: &Model,
    process: &Process,
    manner: Manner,
    (neighbour_offsets, numbering): (Option<Vec<i32>>, Numbering),
) -> Result<Shader, xca_wgsl::Error> {
    let geometry = model.geometry();
    let options = Options {
        precision: manner.precision,
        neighbourhood_size: u32::try_from(geometry.neighbourhood().size()).ok(),
        neighbour_offsets,
        workgroup_size: workgroup_size(geometry.extents(), manner.workgroup),
        numbering,
        boundaries: geometry.boundaries(),
        parity: geometry.neighbourhood().parity(),
        opaque_zero: manner.strict.is_some(),
    };
    texts.of(process, options)
}

/// The size of a workgroup over cells: as long along x as the space allows.
pub(crate) fn workgroup_size([width, height, _]: [usize; 3], workgroup: u32) -> [u32; 3] {
    let x = width.next_power_of_two().min(workgroup as usize) as u32;
    let y = height.next_power_of_two().min((workgroup / x) as usize) as u32;
    [x, y, (workgroup / (x * y)).min(64)]
}

/// Along the axes, unless one of them has too many workgroups for a dispatch.
fn numbering(device: &Device, space: &Space, manner: Manner) -> Numbering {
    let size = workgroup_size(space.geometry().extents(), manner.workgroup);
    let longest = space.sections().iter().flat_map(|section| section.workgroups(size)).max();
    if longest > Some(device.most_workgroups()) { Numbering::Row } else { Numbering::Axes }
}

/// The number by which a process is known whose loops are ended early: its place in the step, from 1.
fn watch_number(stream: Stream) -> Option<NonZeroU32> {
    NonZeroU32::new(u32::from(stream.number()) + 1)
}

impl Program {
    /// Compiles a process.
    pub(crate) fn new(
        device: &Device,
        model: &Model,
        space: &Space,
        (process, stream): (Process, Stream),
        (manner, texts): (Manner, &Texts),
        is_selected: bool,
    ) -> Result<Self, NotOnDevice> {
        let geometry = model.geometry();
        let size = geometry.neighbourhood().size();
        let same = geometry.neighbourhood().parity() == Parity::None;
        let offsets = same.then(|| space.offsets()[..size].to_vec());
        let numbering = if is_selected { Numbering::List } else { numbering(device, space, manner) };
        let shader = shader_of(texts, model, &process, manner, (offsets, numbering))?;
        if shader.needs_f64 && !device.adapter().has_f64 {
            return Err(NotOnDevice::NoF64 { what: format!("the process `{}`", process.name) });
        }
        let most = device.buffers() as usize;
        let bindings = shader.bindings.iter();
        let storage = bindings.filter(|binding| binding.access != BindingAccess::Uniform).count()
            + usize::from(device.turns().is_some());
        if storage > most {
            let process = process.name;
            return Err(NotOnDevice::TooManyBuffers { process, wanted: storage, most });
        }
        let workgroup = match shader.dispatch {
            Dispatch::Cells(size) => size,
            Dispatch::Items(size) => [size, 1, 1],
        };
        let code = Code {
            name: format!("the process `{}`", process.name),
            source: shader.source.clone(),
            workgroup,
            buffers: shader.bindings.iter().map(|binding| access(binding.access)).collect(),
            strict: manner.strict,
            watched: device.turns().and_then(|_| watch_number(stream)),
        };
        let pipeline = device.pipeline(&code)?;
        let mut parameters = Vec::new();
        let (mut spaces, mut offsets, mut directions) = (None, None, None);
        for binding in &shader.bindings {
            match &binding.content {
                Content::Parameters { argument, layout } => {
                    let size = layout.size as usize;
                    let buffer = match binding.access {
                        BindingAccess::Uniform => device.uniform("parameters", &vec![0; size])?,
                        _ => device.buffer("parameters", size as u64)?,
                    };
                    parameters.push(Parameters { argument: *argument, layout: layout.clone(), buffer });
                }
                Content::Space(layout) => {
                    let zeros = vec![0; layout.size as usize];
                    let buffers = space.sections().iter().map(|_| device.uniform("space", &zeros));
                    spaces = Some((layout.clone(), buffers.collect::<Result<_, _>>()?));
                }
                Content::NeighbourOffsets => {
                    let numbers = space.offsets();
                    let buffer = device.buffer("neighbours", size_of_val(&*numbers) as u64)?;
                    device.upload(&buffer, 0, bytemuck::cast_slice(&numbers))?;
                    offsets = Some(buffer);
                }
                Content::NeighbourDirections => {
                    let numbers = space.directions();
                    let buffer = device.buffer("directions", size_of_val(&*numbers) as u64)?;
                    device.upload(&buffer, 0, bytemuck::cast_slice(&numbers))?;
                    directions = Some(buffer);
                }
                _ => {}
            }
        }
        Ok(Self {
            process,
            stream,
            shader,
            pipeline,
            parameters,
            spaces,
            offsets,
            directions,
            notes: None,
            bound: HashMap::new(),
        })
    }

    /// The substates whose results go to a second buffer.
    pub(crate) fn doubled<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = SubstateId> + 'a {
        self.shader.bindings.iter().filter_map(|binding| match binding.content {
            Content::Substate { argument, field, state: State::After, .. } => {
                self.substate(model, argument, field)
            }
            _ => None,
        })
    }

    /// The substates of cells that it writes.
    pub(crate) fn written<'a>(&'a self, model: &'a Model) -> impl Iterator<Item = SubstateId> + 'a {
        self.shader.bindings.iter().filter_map(|binding| match binding.content {
            Content::Substate { argument, field, state: State::After | State::Both, .. } => {
                self.substate(model, argument, field)
            }
            _ => None,
        })
    }

    fn substate(&self, model: &Model, argument: usize, field: usize) -> Option<SubstateId> {
        let group = model.group_number((self.process.substates.get(argument)?.type_id)())?;
        Some(SubstateId { group, field })
    }

    /// The population whose items it runs for or reads.
    pub(crate) fn population(&self, model: &Model) -> Option<usize> {
        model.group_number((self.process.population()?.type_id)())
    }

    /// Whether it may report faults.
    pub(crate) fn may_fault(&self) -> bool {
        self.shader.bindings.iter().any(|binding| matches!(binding.content, Content::Faults(_)))
    }

    /// Hands it the parameters.
    pub(crate) fn set_parameters(
        &self,
        device: &Device,
        values: &ParameterSet,
        precision: Precision,
    ) -> Result<(), DeviceError> {
        self.parameters.iter().try_for_each(|Parameters { argument, layout, buffer }| {
            let type_id = (self.process.parameters[*argument].type_id)();
            match values.struct_of_type(type_id) {
                Some(parameters) => {
                    device.upload(buffer, 0, &values::parameters(layout, parameters, precision))
                }
                None => Ok(()),
            }
        })
    }

    /// Hands it the space and the seed.
    pub(crate) fn set_space(
        &self,
        device: &Device,
        space: &Space,
        seed: u64,
        precision: Precision,
    ) -> Result<(), DeviceError> {
        let Some((layout, buffers)) = &self.spaces else { return Ok(()) };
        space.sections().iter().zip(buffers).try_for_each(|(section, buffer)| {
            // Items are not bound section by section: their cells have the numbers of the whole space.
            let whole = Section { base: 0, ..section.clone() };
            let section = if self.process.kind == ProcessKind::Cells { section } else { &whole };
            device.upload(buffer, 0, &values::space(layout, space, section, (seed, self.stream), precision))
        })
    }

    /// The runs of the process: for each section of the space one, or one for all items.
    pub(crate) fn dispatches(
        &mut self,
        device: &Device,
        model: &Model,
        space: &Space,
        groups: &Groups,
    ) -> Result<Vec<(Bindings, [u32; 3])>, DeviceError> {
        match self.shader.dispatch {
            Dispatch::Items(size) => {
                let items = self.population(model).map_or(0, |group| groups.items(group));
                let workgroups = service::workgroups(device, items.div_ceil(size as usize));
                let parts = self.buffers(model, groups, 0, None);
                Ok(vec![(self.bind(device, parts)?, workgroups)])
            }
            Dispatch::Cells(size) => (0..space.sections().len())
                .map(|number| {
                    let section = &space.sections()[number];
                    let along = section.workgroups(size);
                    let workgroups = match self.shader.numbering {
                        Numbering::Axes => along,
                        Numbering::Row | Numbering::List => {
                            service::workgroups(device, along.iter().map(|count| *count as usize).product())
                        }
                    };
                    let parts = self.buffers(model, groups, number, Some(section));
                    Ok((self.bind(device, parts)?, workgroups))
                })
                .collect(),
        }
    }

    /// Has it note in which tiles it changes something.
    pub(crate) fn note_in(&mut self, notes: Binding) {
        self.notes = Some(notes);
    }

    /// The process with all cells in reach.
    pub(crate) fn bound(
        &mut self,
        device: &Device,
        model: &Model,
        space: &Space,
        groups: &Groups,
    ) -> Result<Bindings, DeviceError> {
        let parts = self.buffers(model, groups, 0, space.sections().first());
        self.bind(device, parts)
    }

    fn bind(&mut self, device: &Device, parts: Vec<Binding>) -> Result<Bindings, DeviceError> {
        let key: Vec<_> = parts.iter().map(Binding::key).collect();
        if let Some(bindings) = self.bound.get(&key) {
            return Ok(bindings.clone());
        }
        let bindings = device.bind(&self.pipeline, &parts)?;
        self.bound.insert(key, bindings.clone());
        Ok(bindings)
    }

    /// Forgets buffers that are no longer there.
    pub(crate) fn forget(&mut self) {
        self.bound.clear();
    }

    /// The buffers in the order of their numbers.
    fn buffers(
        &self,
        model: &Model,
        groups: &Groups,
        number: usize,
        section: Option<&Section>,
    ) -> Vec<Binding> {
        let population = self.population(model);
        let bindings = self.shader.bindings.iter();
        bindings
            .filter_map(|binding| match &binding.content {
                Content::Space(_) => {
                    self.spaces.as_ref().and_then(|(_, parts)| parts.get(number)).map(Binding::from)
                }
                Content::Parameters { argument, .. } => {
                    let given = self.parameters.iter().find(|given| given.argument == *argument);
                    given.map(|given| Binding::from(&given.buffer))
                }
                Content::NeighbourOffsets => self.offsets.as_ref().map(Binding::from),
                Content::NeighbourDirections => self.directions.as_ref().map(Binding::from),
                Content::Moment(_) => Some(groups.journal(population)),
                Content::Faults(_) => Some(groups.faults().into()),
                Content::Activity => self.notes.clone(),
                Content::Substate { argument, field, state, .. } => {
                    let id = self.substate(model, *argument, *field)?;
                    groups.substate(id, *state == State::After, section)
                }
                content => match groups.group(population?) {
                    Group::Cells(_) => None,
                    Group::Population(population) => population.binding(content, section),
                },
            })
            .chain(groups.ended_early().map(Binding::from))
            .collect()
    }
}

fn access(access: BindingAccess) -> Access {
    match access {
        BindingAccess::Uniform => Access::Uniform,
        BindingAccess::Read => Access::Read,
        BindingAccess::ReadWrite => Access::Write,
    }
}
