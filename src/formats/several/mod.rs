//! Files that make one model together: companions, populations of shapes, blendshapes.

pub(crate) mod blendshapes;
pub(crate) mod companions;
pub(crate) mod groups;
pub(crate) mod naming;
pub(crate) mod populations;
mod specimens;
pub(crate) mod table;
