// A Piece of VTK's XML files.
#pragma once

#include "engine/files/foreign/vtk/vtk_frame.hpp"
#include "engine/files/foreign/vtk/xml_arrays.hpp"

namespace grainreel {

// Throws UserError with the line.
VtkPiece xml_piece(const XmlArrays& arrays, const XmlElement& piece, bool poly_data, VtkPart part);

// Throws UserError where the cells' ends are in no order, or where a corner is no point. Polyhedra are
// checked where they are split.
void check_cells(const VtkPiece& piece);

}  // namespace grainreel
