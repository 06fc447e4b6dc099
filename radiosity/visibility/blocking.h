#pragma once

namespace radiosity {

/// What an occluder can do to the segments between two sets of points. Only `none` and `all` are
/// proofs; `some` may also stand for "not found out".
enum class Blocking { none, some, all };

}  // namespace radiosity
