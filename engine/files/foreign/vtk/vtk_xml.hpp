// Reads VTK's XML files of points and cells: PolyData (.vtp), UnstructuredGrid (.vtu), and lists of pieces of
// such files (.pvtp, .pvtu).
#pragma once

#include <filesystem>

#include "engine/files/foreign/raw_file.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"
#include "engine/files/foreign/vtk/xml_arrays.hpp"

namespace grainreel {

RawFormat vtk_xml_format();

// Throws UserError with file and line for damage, a missing piece, grids, and cells whose surface cannot be
// read.
VtkContents read_vtk_xml(const std::filesystem::path& file, VtkPart part);

// The time in a comment or a title, " time 1.00013" or " Time = 0.5 sec. "; none where there is none.
std::optional<double> time_in_words(std::string_view words);

// Reads a Piece element. Throws UserError with the line.
VtkPiece xml_piece(const XmlArrays& arrays, const XmlElement& piece, bool poly_data, VtkPart part);

// Throws UserError where a corner is no point of the piece. Polyhedra are checked when they are split.
void check_cells(const VtkPiece& piece);

}  // namespace grainreel
