#include "engine/files/foreign/vtk/vtk_xml.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <cmath>
#include <set>

#include "engine/base/error.hpp"
#include "engine/base/lists.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/bytes/byte_source.hpp"
#include "engine/files/foreign/vtk/vtk_frame.hpp"
#include "engine/files/foreign/vtk/vtk_numbers.hpp"

namespace grainreel {

namespace {

namespace fs = std::filesystem;

bool is_list(std::string_view type) {
    return type == "PPolyData" || type == "PUnstructuredGrid";
}

[[noreturn]] void refuse_type(const fs::path& file, const XmlElement& root, std::string_view type) {
    constexpr std::string_view grids[] = {"ImageData",       "RectilinearGrid", "StructuredGrid",
                                          "UniformGrid",     "PImageData",      "PRectilinearGrid",
                                          "PStructuredGrid", "HyperTreeGrid"};
    if (std::find(std::begin(grids), std::end(grids), type) != std::end(grids))
        refuse_line(file, root.line,
                    fmt::format("holds a grid, not grains (VTK's {}); give a file of PolyData or "
                                "UnstructuredGrid",
                                type));
    refuse_line(
        file, root.line,
        fmt::format("holds VTK's \"{}\", which is not read; give a file of PolyData or UnstructuredGrid",
                    excerpt(type)));
}

// The words in a text of numbers: a word is the codes of its letters and a 0. Empty where the text is no list
// of words.
std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> all(1);
    WordReader numbers(text);
    while (const std::optional<double> value = numbers.next_number()) {
        if (!(*value >= 0 && *value < 256)) return {};
        if (*value == 0)
            all.emplace_back();
        else
            all.back() += static_cast<char>(static_cast<unsigned char>(*value));
    }
    if (numbers.has_word() || !all.back().empty()) return {};
    all.pop_back();
    return all;
}

// The names of species. There are none unless all differ and each is valid UTF-8 and not empty.
std::vector<std::string> species_of(const XmlArrays& arrays, const XmlElement& array) {
    const std::string_view format = array.attribute("format");
    if (!format.empty() && format != "ascii") return {};
    std::vector<std::string> names = words_of(arrays.short_text(array));
    const std::set<std::string> different(names.begin(), names.end());
    const bool fine = std::all_of(names.begin(), names.end(), [](const std::string& name) {
        return !name.empty() && complaint_of_utf8(name).empty();
    });
    return fine && different.size() == names.size() ? names : std::vector<std::string>();
}

// Takes time, step and the names of species from an element FieldData.
void read_field(const XmlArrays& arrays, const XmlElement& field, VtkContents& contents) {
    for (const XmlElement& array : field.children) {
        const std::string_view name = array.attribute("Name");
        if (array.name == "Array" && array.attribute("type") == "String" && name == "species")
            contents.species = species_of(arrays, array);
        const bool time = name == "TimeValue" || name == "TIME";
        if (array.name != "DataArray" || (!time && name != "CYCLE") || !vtk_xml_type(array.attribute("type")))
            continue;
        const std::vector<double> values = arrays.numbers(array, std::nullopt, false);
        if (values.size() != 1 || !std::isfinite(values[0])) continue;
        if (time)
            contents.time = values[0];
        else
            contents.step = static_cast<std::int64_t>(std::clamp(values[0], -9e15, 9e15));
    }
}

void read_words(const XmlTree& tree, VtkContents& contents) {
    for (const std::string& comment : tree.comments) {
        if (!contents.time) contents.time = time_in_words(comment);
        if (comment.find("deal.II") != std::string::npos) contents.program = "deal.II";
    }
}

// The file of a piece. Throws UserError where it does not exist.
fs::path file_of_piece(const fs::path& file, const XmlElement& piece) {
    const std::string source = named_file(file.parent_path(), piece.attribute("Source"));
    if (source.empty()) refuse_line(file, piece.line, "a piece without a file: its Source is missing");
    const fs::path path = file.parent_path() / source;
    if (!is_plain(path))
        refuse_line(
            file, piece.line,
            fmt::format("its piece \"{}\" is not there; copy it beside this file", excerpt(source, 200)));
    return path;
}

void add_pieces_of(const fs::path& file, const XmlElement& piece, VtkPart part, VtkContents& contents) {
    const fs::path path = file_of_piece(file, piece);
    const std::string type = vtk_file_type(unpacked_head(path).bytes);
    if (is_list(type))
        refuse_line(file, piece.line,
                    fmt::format("its piece \"{}\" is a list of pieces itself",
                                excerpt(piece.attribute("Source"), 200)));
    if (type.empty()) refuse_file(path, fmt::format("is no file of VTK in XML, as a piece must be"));
    VtkContents more = read_vtk_xml(path, part);
    if (!contents.time) contents.time = more.time;
    if (!contents.step) contents.step = more.step;
    if (contents.species.empty()) contents.species = more.species;
    if (contents.program.empty()) contents.program = more.program;
    std::move(more.pieces.begin(), more.pieces.end(), std::back_inserter(contents.pieces));
}

bool takes_vtk_xml(const FileStart& head) {
    const std::string type = vtk_file_type(head.bytes);
    return !type.empty() && type != "Collection" && type != "vtkMultiBlockDataSet" &&
           type != "vtkPartitionedDataSetCollection" && type != "vtkPartitionedDataSet";
}

std::unique_ptr<RawFile> open_vtk_xml(const fs::path& file) {
    return open_vtk_file(file, &read_vtk_xml);
}

}  // namespace

RawFormat vtk_xml_format() {
    return {"vtk-xml", "VTK files in XML (.vtp, .vtu, .pvtp, .pvtu)", &takes_vtk_xml, &open_vtk_xml};
}

std::optional<double> time_in_words(std::string_view words) {
    for (std::size_t at = 0; at + 4 <= words.size(); ++at) {
        if (!same_word(words.substr(at, 4), "time") ||
            (at > 0 && std::isalnum(static_cast<unsigned char>(words[at - 1]))))
            continue;
        std::size_t next = at + 4;
        while (next < words.size() && std::string_view(" \t=:").find(words[next]) != std::string_view::npos)
            ++next;
        std::size_t end = next;
        while (end < words.size() &&
               std::string_view("0123456789+-.eE").find(words[end]) != std::string_view::npos)
            ++end;
        while (end > next && std::string_view("+-eE").find(words[end - 1]) != std::string_view::npos) --end;
        if (const auto time = number_in(words.substr(next, end - next)); time && next > at + 4) return time;
    }
    return std::nullopt;
}

VtkContents read_vtk_xml(const fs::path& file, VtkPart part) {
    const Content content(file);
    const XmlTree tree = xml_tree(content);
    const std::string_view type = tree.root.attribute("type");
    if (type != "PolyData" && type != "UnstructuredGrid" && !is_list(type))
        refuse_type(file, tree.root, type);
    const XmlElement* set = tree.root.child(type);
    if (set == nullptr)
        refuse_line(file, tree.root.line, fmt::format("its element {} is missing; {}", type, kWriteAgain));
    const XmlArrays arrays(content, tree);
    VtkContents contents;
    contents.format = fmt::format("VTK XML, {}", type);
    read_words(tree, contents);
    for (const XmlElement* field : {tree.root.child("FieldData"), set->child("FieldData")})
        if (field != nullptr) read_field(arrays, *field, contents);
    for (const XmlElement& piece : set->children) {
        if (piece.name != "Piece") continue;
        if (is_list(type))
            add_pieces_of(file, piece, part, contents);
        else
            contents.pieces.push_back(xml_piece(arrays, piece, type == "PolyData", part));
    }
    return contents;
}

namespace {

const XmlElement* array_named(const XmlElement& element, std::string_view name) {
    for (const XmlElement& array : element.children)
        if (array.name == "DataArray" && array.attribute("Name") == name) return &array;
    return nullptr;
}

const XmlElement& needed(const XmlArrays& arrays, const XmlElement& element, std::string_view name) {
    if (const XmlElement* array = array_named(element, name)) return *array;
    refuse_line(arrays.file(), element.line,
                fmt::format("its array \"{}\" is missing from {}; {}", name, element.name, kWriteAgain));
}

// Adds the ends and corners of cells, but not their types.
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

// Reads Verts, Lines, Polys and Strips in the order of the cell data.
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
            refuse_line(
                arrays.file(), piece.line,
                fmt::format("{}=\"{}\", and no {}; {}", kind.count, count, kind.element, kWriteAgain));
        const std::size_t before = cells.ends.size();
        add_corners(arrays, *element, count, cells);
        for (std::size_t i = before; i < cells.ends.size(); ++i)
            cells.types.push_back(cells.end_of(i) - cells.begin_of(i) == kind.corners_of_one ? kind.one
                                                                                             : kind.more);
    }
}

// Replaces the corners of polyhedra by their streams of faces.
void add_faces(const XmlArrays& arrays, const XmlElement& element, VtkCells& cells) {
    if (!contains(cells.types, VtkCell::polyhedron)) return;
    if (array_named(element, "faces") == nullptr && array_named(element, "face_connectivity") != nullptr)
        refuse_line(arrays.file(), element.line,
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
        refuse_line(arrays.file(), piece.line,
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
        // Arrays of words are skipped.
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
        refuse_line(arrays.file(), piece.line,
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
                throw UserError("{}: cell {} names point {}, and there are {}, from 0; {}", piece.where, cell,
                                cells.corners[i], piece.points, kWriteAgain);
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
