#pragma once

#include <span>
#include <vector>

#include "meshing/patches/contact_lines.h"
#include "radiosity/base/geometry.h"
#include "radiosity/base/progress.h"
#include "radiosity/scene/patch_mesh.h"

namespace meshing {

/// The mesh with patches cut along the contact lines of their polygons (`polygon_contact_lines`,
/// one list per input polygon), so that none reaches to both sides of what stands on it. Corners
/// close to a line are moved onto it, within their polygon and along its outline, which spares
/// slivers; the first `n_fixed` vertices, the corners of the input, stay where they are. What is
/// cut is divided alike on both sides of every edge, so that no T-vertices come up; patches away
/// from the lines stay as they are, and parts of one patch follow each other. Not cut are pieces
/// narrower than 1e-5 of their length. Deterministic. Throws Interrupted.
radiosity::PatchMesh cut_along_contacts(const radiosity::PatchMesh& mesh,
                                        std::span<const std::vector<Segment>> lines,
                                        radiosity::Index n_fixed,
                                        const radiosity::Progress& progress = {});

}  // namespace meshing
