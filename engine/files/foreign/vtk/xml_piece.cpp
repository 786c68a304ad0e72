#include "engine/files/foreign/vtk/xml_piece.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/error.hpp"

namespace grainreel {
namespace {

const XmlElement* array_named(const XmlElement& element, std::string_view name) {
    for (const XmlElement& array : element.children)
        if (array.name == "DataArray" && array.attribute("Name") == name) return &array;
    return nullptr;
}

const XmlElement& needed(const XmlArrays& arrays, const XmlElement& element, std::string_view name) {
    if (const XmlElement* array = array_named(element, name)) return *array;
    refuse_vtk_line(arrays.file(), element.line,
                    fmt::format("its array \"{}\" is missing from {}; {}", name, element.name, kWriteAgain));
}

// Adds cells by their corners; the types follow.
void add_corners(const XmlArrays& arrays, const XmlElement& element, std::uint64_t count, VtkCells& cells) {
    const XmlElement& offsets = needed(arrays, element, "offsets");
    const std::vector<std::int64_t> ends = arrays.whole(offsets, count);
    const auto before = static_cast<std::int64_t>(cells.corners.size());
    std::int64_t last = 0;
    for (const std::int64_t end : ends) {
        if (end < last)
            refuse_vtk(arrays.place_of(offsets),
                       fmt::format("offset {} after {}; {}", end, last, kWriteAgain));
        cells.ends.push_back(before + end);
        last = end;
    }
    const std::vector<std::int64_t> corners =
        arrays.whole(needed(arrays, element, "connectivity"), static_cast<std::uint64_t>(last));
    cells.corners.insert(cells.corners.end(), corners.begin(), corners.end());
}

// Verts, lines, polygons and strips, in the order of the cell data.
void add_poly_cells(const XmlArrays& arrays, const XmlElement& piece, VtkCells& cells) {
    struct Kind {
        const char *count, *element;
        VtkCell::Type one, more;
        std::size_t corners_of_one;
    };
    constexpr Kind kinds[] = {{"NumberOfVerts", "Verts", VtkCell::vertex, VtkCell::poly_vertex, 1},
                              {"NumberOfLines", "Lines", VtkCell::line, VtkCell::poly_line, 2},
                              {"NumberOfPolys", "Polys", VtkCell::polygon, VtkCell::polygon, 0},
                              {"NumberOfStrips", "Strips", VtkCell::strip, VtkCell::strip, 0}};
    for (const Kind& kind : kinds) {
        const std::uint64_t count = arrays.count_in(piece, kind.count);
        if (count == 0) continue;
        const XmlElement* element = piece.child(kind.element);
        if (element == nullptr)
            refuse_vtk_line(
                arrays.file(), piece.line,
                fmt::format("{}=\"{}\", and no {}; {}", kind.count, count, kind.element, kWriteAgain));
        const std::size_t before = cells.ends.size();
        add_corners(arrays, *element, count, cells);
        for (std::size_t i = before; i < cells.ends.size(); ++i)
            cells.types.push_back(cells.end_of(i) - cells.begin_of(i) == kind.corners_of_one ? kind.one
                                                                                             : kind.more);
    }
}

// Puts the streams of faces in the place of the corners of polyhedra.
void add_faces(const XmlArrays& arrays, const XmlElement& element, VtkCells& cells) {
    if (std::find(cells.types.begin(), cells.types.end(), VtkCell::polyhedron) == cells.types.end()) return;
    if (array_named(element, "faces") == nullptr && array_named(element, "face_connectivity") != nullptr)
        refuse_vtk_line(
            arrays.file(), element.line,
            "polyhedra in the form of VTK 9.4, which are not read; write the file in an older form");
    const XmlElement& offsets = needed(arrays, element, "faceoffsets");
    const std::vector<std::int64_t> stream = arrays.whole(needed(arrays, element, "faces"), std::nullopt);
    const std::vector<std::int64_t> ends = arrays.whole(offsets, cells.size());
    VtkCells changed;
    changed.types = cells.types;
    std::int64_t last = 0;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        if (cells.types[cell] == VtkCell::polyhedron) {
            if (ends[cell] < last || ends[cell] > static_cast<std::int64_t>(stream.size()))
                refuse_vtk(arrays.place_of(offsets),
                           fmt::format("offset {} is out of order; {}", ends[cell], kWriteAgain));
            changed.corners.insert(changed.corners.end(), stream.begin() + last, stream.begin() + ends[cell]);
            last = ends[cell];
        } else {
            const auto from = static_cast<std::ptrdiff_t>(cells.begin_of(cell));
            changed.corners.insert(changed.corners.end(), cells.corners.begin() + from,
                                   cells.corners.begin() + static_cast<std::ptrdiff_t>(cells.end_of(cell)));
        }
        changed.ends.push_back(static_cast<std::int64_t>(changed.corners.size()));
    }
    cells = std::move(changed);
}

void add_cells(const XmlArrays& arrays, const XmlElement& piece, VtkCells& cells) {
    const std::uint64_t count = arrays.count_in(piece, "NumberOfCells");
    if (count == 0) return;
    const XmlElement* element = piece.child("Cells");
    if (element == nullptr)
        refuse_vtk_line(arrays.file(), piece.line,
                        fmt::format("NumberOfCells=\"{}\", and no Cells; {}", count, kWriteAgain));
    for (const std::int64_t type : arrays.whole(needed(arrays, *element, "types"), count))
        cells.types.push_back(static_cast<std::uint8_t>(std::clamp<std::int64_t>(type, 0, 255)));
    add_corners(arrays, *element, count, cells);
    add_faces(arrays, *element, cells);
}

void add_data(const XmlArrays& arrays, const XmlElement& piece, const char* name, std::size_t tuples,
              VtkPart part, std::vector<VtkArray>& data) {
    const XmlElement* element = piece.child(name);
    if (element == nullptr) return;
    for (const XmlElement& array : element->children) {
        // Words are passed over.
        if (array.name != "DataArray" || array.attribute("type") == "String") continue;
        const std::uint64_t components =
            std::max<std::uint64_t>(arrays.count_in(array, "NumberOfComponents"), 1);
        if (components > 1024)
            refuse_vtk(arrays.place_of(array),
                       fmt::format("has {} components; at most 1024 are read", components));
        arrays.check(array, tuples * components);
        if (part == VtkPart::cells) continue;
        data.push_back({std::string(array.attribute("Name")), components,
                        arrays.numbers(array, tuples * components, false)});
    }
}

void add_places(const XmlArrays& arrays, const XmlElement& piece, VtkPart part, VtkPiece& read) {
    if (read.points == 0) return;
    const XmlElement* points = piece.child("Points");
    const XmlElement* array = points == nullptr ? nullptr : points->child("DataArray");
    if (array == nullptr)
        refuse_vtk_line(arrays.file(), piece.line,
                        fmt::format("NumberOfPoints=\"{}\", and no Points; {}", read.points, kWriteAgain));
    if (array->has("NumberOfComponents") && arrays.count_in(*array, "NumberOfComponents") != 3)
        refuse_vtk(arrays.place_of(*array), "its places must have three components");
    arrays.check(*array, 3 * read.points);
    if (part == VtkPart::all) read.places = arrays.numbers(*array, 3 * read.points, true);
}

}  // namespace

void check_cells(const VtkPiece& piece) {
    const VtkCells& cells = piece.cells;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        if (cells.types[cell] == VtkCell::polyhedron) continue;
        for (std::size_t i = cells.begin_of(cell); i < cells.end_of(cell); ++i)
            if (cells.corners[i] < 0 || cells.corners[i] >= static_cast<std::int64_t>(piece.points))
                throw UserError(fmt::format("{}: cell {} names point {}, and there are {}, from 0; {}",
                                            piece.where, cell, cells.corners[i], piece.points, kWriteAgain));
    }
}

VtkPiece xml_piece(const XmlArrays& arrays, const XmlElement& piece, bool poly_data, VtkPart part) {
    VtkPiece read;
    read.where = text_of({&arrays.file(), piece.line});
    read.points = arrays.count_in(piece, "NumberOfPoints");
    add_places(arrays, piece, part, read);
    if (poly_data)
        add_poly_cells(arrays, piece, read.cells);
    else
        add_cells(arrays, piece, read.cells);
    check_cells(read);
    add_data(arrays, piece, "PointData", read.points, part, read.point_data);
    add_data(arrays, piece, "CellData", read.cells.size(), part, read.cell_data);
    return read;
}

}  // namespace grainreel
