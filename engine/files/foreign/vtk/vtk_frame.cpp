#include "engine/files/foreign/vtk/vtk_frame.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/numbers.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

std::vector<double> gathered(const std::vector<double>& values, std::size_t components, std::size_t component,
                             const VtkRows& rows) {
    std::vector<double> column(rows.count);
    for (std::size_t i = 0; i < rows.count; ++i) {
        const std::size_t tuple = rows.all ? i : rows.tuples[i];
        column[i] = tuple == kNoTuple ? kUnknown : values[tuple * components + component];
    }
    return column;
}

std::string names_of(const std::vector<RawColumn>& columns) {
    std::string names;
    for (const RawColumn& column : columns) names += (names.empty() ? "" : ", ") + column.name;
    return excerpt(names, 200);
}

bool same_names(const std::vector<RawColumn>& some, const std::vector<RawColumn>& others) {
    if (some.size() != others.size()) return false;
    for (std::size_t i = 0; i < some.size(); ++i)
        if (some[i].name != others[i].name) return false;
    return true;
}

}  // namespace

std::vector<RawColumn> columns_of(std::vector<VtkArray>&& arrays, const VtkRows& rows) {
    std::vector<RawColumn> columns;
    for (VtkArray& array : arrays) {
        if (array.components == 1 && rows.all) {
            columns.push_back({array.name, std::move(array.values)});
            continue;
        }
        for (std::size_t c = 0; c < array.components; ++c)
            columns.push_back({array.components == 1 ? array.name : fmt::format("{}:{}", array.name, c),
                               gathered(array.values, array.components, c, rows)});
        array.values = {};
    }
    return columns;
}

std::vector<RawColumn> place_columns(const std::vector<double>& places, const VtkRows& rows,
                                     const char* tail) {
    std::vector<RawColumn> columns;
    for (std::size_t c = 0; c < 3; ++c)
        columns.push_back({std::string(1, "xyz"[c]) + tail, gathered(places, 3, c, rows)});
    return columns;
}

void add_rows(RawTable& table, std::vector<RawColumn>&& columns, std::size_t rows, const std::string& where) {
    if (rows == 0) {
        // The names of columns are kept even if the table is empty.
        if (table.rows == 0 && table.columns.empty()) table.columns = std::move(columns);
        return;
    }
    if (table.rows == 0) {
        table.columns = std::move(columns);
        table.rows = rows;
        return;
    }
    if (!same_names(table.columns, columns))
        throw UserError(
            "{}: this piece has the columns {}, and those before it have {}; write all of "
            "them with the same arrays",
            where, names_of(columns), names_of(table.columns));
    for (std::size_t i = 0; i < columns.size(); ++i)
        table.columns[i].values.insert(table.columns[i].values.end(), columns[i].values.begin(),
                                       columns[i].values.end());
    table.rows += rows;
}

namespace {

namespace fs = std::filesystem;

bool is_vertex(std::uint8_t type) {
    return type == VtkCell::vertex || type == VtkCell::poly_vertex;
}
bool is_line(std::uint8_t type) {
    return type == VtkCell::line || type == VtkCell::poly_line;
}
bool is_contact(const VtkCells& cells, std::size_t cell) {
    return is_line(cells.types[cell]) && cells.end_of(cell) - cells.begin_of(cell) == 2;
}

// The points that are grains, and the vertex cell of each.
struct PieceGrains {
    VtkRows points, cells;
};

// A point with several vertex cells is one grain with the numbers of the first cell.
PieceGrains grains_of(const VtkPiece& piece) {
    const VtkCells& cells = piece.cells;
    PieceGrains grains;
    if (cells.size() == 0) {
        grains.points.count = piece.points;
        return grains;
    }
    if (std::none_of(cells.types.begin(), cells.types.end(), is_vertex)) return grains;
    std::vector<std::size_t> cell_of(piece.points, kNoTuple);
    bool in_order = cells.size() == piece.points;
    for (std::size_t cell = 0; cell < cells.size(); ++cell) {
        if (!is_vertex(cells.types[cell])) continue;
        for (std::size_t i = cells.begin_of(cell); i < cells.end_of(cell); ++i) {
            std::size_t& mine = cell_of[cells.corners[i]];
            if (mine == kNoTuple) mine = cell;
        }
    }
    for (std::size_t point = 0; point < piece.points; ++point) in_order = in_order && cell_of[point] == point;
    if (in_order) {
        grains.points.count = grains.cells.count = piece.points;
        return grains;
    }
    grains.points.all = grains.cells.all = false;
    for (std::size_t point = 0; point < piece.points; ++point) {
        if (cell_of[point] == kNoTuple) continue;
        grains.points.tuples.push_back(point);
        grains.cells.tuples.push_back(cell_of[point]);
    }
    grains.points.count = grains.cells.count = grains.points.tuples.size();
    return grains;
}

void add_grains(VtkPiece& piece, RawTable& table) {
    const PieceGrains grains = grains_of(piece);
    if (grains.points.count == 0 && piece.points > 0) return;
    std::vector<RawColumn> columns = place_columns(piece.places, grains.points, "");
    std::vector<RawColumn> more = columns_of(std::move(piece.point_data), grains.points);
    std::move(more.begin(), more.end(), std::back_inserter(columns));
    if (piece.cells.size() > 0) {
        std::vector<VtkArray> data = piece.cell_data;
        more = columns_of(std::move(data), grains.cells);
        std::move(more.begin(), more.end(), std::back_inserter(columns));
    }
    add_rows(table, std::move(columns), grains.points.count, piece.where);
}

void add_contacts(const VtkPiece& piece, RawTable& table) {
    VtkRows lines{0, false, {}}, first = lines, second = lines;
    for (std::size_t cell = 0; cell < piece.cells.size(); ++cell) {
        if (!is_contact(piece.cells, cell)) continue;
        const std::size_t corner = piece.cells.begin_of(cell);
        lines.tuples.push_back(cell);
        first.tuples.push_back(static_cast<std::size_t>(piece.cells.corners[corner]));
        second.tuples.push_back(static_cast<std::size_t>(piece.cells.corners[corner + 1]));
    }
    lines.count = first.count = second.count = lines.tuples.size();
    if (lines.count == 0) return;
    std::vector<RawColumn> columns = place_columns(piece.places, first, "1");
    std::vector<VtkArray> data = piece.cell_data;
    for (auto& more : {place_columns(piece.places, second, "2"), columns_of(std::move(data), lines)})
        columns.insert(columns.end(), more.begin(), more.end());
    add_rows(table, std::move(columns), lines.count, piece.where);
}

// Turns types into words if the file names all of them.
void name_types(RawTable& table, const std::vector<std::string>& names) {
    for (RawColumn& column : table.columns) {
        if (column.name != "type") continue;
        const auto has_name = [&](double type) {
            return type >= 1 && type <= static_cast<double>(names.size()) && type == std::floor(type);
        };
        if (names.empty() || !std::all_of(column.values.begin(), column.values.end(), has_name)) return;
        for (double& type : column.values) --type;
        column.words = names;
    }
}

// Turns types back into numbers, for rows of the same moment with other names.
void unname_types(RawColumn& column) {
    if (column.words.empty()) return;
    for (double& type : column.values) ++type;
    column.words.clear();
}

void merge_tables(RawTable& table, RawTable&& more) {
    if (table.rows == 0 || more.rows == 0) {
        if (table.rows == 0 && (more.rows > 0 || table.columns.empty())) table = std::move(more);
        return;
    }
    for (RawColumn& column : more.columns) {
        const RawColumn* mine = table.find(column.name);
        if (mine == nullptr || mine->words != column.words) unname_types(column);
        if (mine == nullptr)
            table.columns.push_back({column.name, std::vector<double>(table.rows, kUnknown)});
    }
    for (RawColumn& column : table.columns) {
        const RawColumn* other = more.find(column.name);
        if (other == nullptr || other->words != column.words) unname_types(column);
        if (other == nullptr)
            column.values.resize(table.rows + more.rows, kUnknown);
        else
            column.values.insert(column.values.end(), other->values.begin(), other->values.end());
    }
    table.rows += more.rows;
}

// A file that holds one frame.
class VtkFile : public RawFile {
  public:
    using Read = VtkContents (*)(const fs::path& file, VtkPart part);

    VtkFile(fs::path file, Read by) : RawFile(std::move(file)), read_(by) {
        const VtkContents contents = read_(file_, VtkPart::cells);
        const VtkCount count = count_of(contents.pieces);
        facts_.format = contents.format;
        facts_.program = contents.program;
        moments_.push_back({contents.step, contents.time, count.grains, count.contacts > 0, count.walls});
        const std::string name = excerpt(file_.string(), 400);
        for (const std::string& line : contents.news) news_.push_back(fmt::format("{}: {}", name, line));
        if (count.points_left_out > 0)
            news_.push_back(fmt::format("{}: {} of its points have no vertex cell and are left out", name,
                                        count.points_left_out));
        if (count.lines_left_out > 0)
            news_.push_back(
                fmt::format("{}: {} lines that do not join two points are no contacts and are left out", name,
                            count.lines_left_out));
    }

    RawFrame read(std::size_t) const override { return frame_of(read_(file_, VtkPart::all)); }

  private:
    Read read_;
};

}  // namespace

VtkCount count_of(const std::vector<VtkPiece>& pieces) {
    VtkCount count;
    std::vector<VtkTriangle> triangles;
    for (const VtkPiece& piece : pieces) {
        const std::size_t grains = grains_of(piece).points.count;
        count.grains += static_cast<std::int64_t>(grains);
        bool others = false;
        for (std::size_t cell = 0; cell < piece.cells.size(); ++cell) {
            const std::uint8_t type = piece.cells.types[cell];
            if (is_contact(piece.cells, cell))
                ++count.contacts;
            else if (is_line(type))
                ++count.lines_left_out;
            else if (is_surface(type)) {
                split_cell(piece, cell, triangles);
                count.walls = count.walls || !triangles.empty();
                triangles.clear();
            }
            others = others || !is_vertex(type);
        }
        if (grains > 0 && !others) count.points_left_out += static_cast<std::int64_t>(piece.points - grains);
    }
    return count;
}

RawFrame frame_of(VtkContents&& contents) {
    RawFrame frame;
    frame.step = contents.step;
    frame.time = contents.time;
    for (VtkPiece& piece : contents.pieces) {
        std::vector<RawWall> walls = walls_of(piece);
        // Two walls that can be joined are pieces of one surface, which several processes wrote.
        if (walls.size() == 1 && frame.walls.size() == 1 && join_walls(frame.walls[0], walls[0]))
            walls.clear();
        std::move(walls.begin(), walls.end(), std::back_inserter(frame.walls));
        add_contacts(piece, frame.contacts);
        add_grains(piece, frame.grains);
        piece = {};
    }
    name_types(frame.grains, contents.species);
    return frame;
}

void merge_frames(RawFrame& frame, RawFrame&& more) {
    merge_tables(frame.grains, std::move(more.grains));
    merge_tables(frame.contacts, std::move(more.contacts));
    std::move(more.walls.begin(), more.walls.end(), std::back_inserter(frame.walls));
    if (!frame.time) frame.time = more.time;
    if (!frame.step) frame.step = more.step;
    if (!frame.box) frame.box = more.box;
}

std::unique_ptr<RawFile> open_vtk_file(const fs::path& file, VtkFile::Read read) {
    return std::make_unique<VtkFile>(file, read);
}

}  // namespace grainreel
