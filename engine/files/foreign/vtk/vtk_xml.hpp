// Files of VTK in XML that hold points and cells: PolyData (.vtp), UnstructuredGrid (.vtu) and the lists of
// their pieces (.pvtp, .pvtu).
#pragma once

#include <filesystem>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"
#include "engine/files/foreign/vtk/xml_arrays.hpp"

namespace grainreel {

RawFormat vtk_xml_format();

// Throws UserError with file and line: damage, a missing piece, grids, cells whose surface is not read.
VtkContents read_vtk_xml(const std::filesystem::path& file, VtkPart part);

// The time in a comment or a title, " time 1.00013" or " Time = 0.5 sec. "; none where it does not speak of
// it.
std::optional<double> time_in_words(std::string_view words);

// A Piece of VTK's XML files.

// Throws UserError with the line.
VtkPiece xml_piece(const XmlArrays& arrays, const XmlElement& piece, bool poly_data, VtkPart part);

// Throws UserError where the cells' ends are in no order, or where a corner is no point. Polyhedra are
// checked where they are split.
void check_cells(const VtkPiece& piece);

}  // namespace grainreel
