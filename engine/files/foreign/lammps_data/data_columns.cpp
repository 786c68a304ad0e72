#include "engine/files/foreign/lammps_data/data_columns.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <functional>
#include <optional>

#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/files/foreign/tables/number_words.hpp"

namespace grainreel {

namespace {

// Sources: LAMMPS manual, commands read_data and atom_style; LIGGGHTS manual, command atom_style.

constexpr std::size_t kImages = 3;  // columns of periodic images, which may follow in each row

// The columns that a style adds to id, type, x, y and z where it stands before sphere in a hybrid. All of
// these add nothing to the section Velocities.
struct AddedColumns {
    const char* style;
    std::size_t columns;
};
constexpr std::array<AddedColumns, 7> kAdded{
    {{"atomic", 0}, {"bond", 1}, {"angle", 1}, {"molecular", 1}, {"charge", 1}, {"full", 2}, {"dipole", 4}}};

constexpr const char* kWays =
    "spheres have atom_style sphere, granular or bpm/sphere, and a dump of other atoms is read with --radius "
    "2mm";

// A style as a data file names it: "sphere/kk" is sphere. Styles "granular" and "sphere" have the same
// columns.
std::string plain_style(std::string_view style) {
    std::string name = lower_case(style);
    for (const std::string_view suffix : {"/kk", "/omp", "/gpu"})
        if (name.ends_with(suffix)) name.erase(name.size() - suffix.size());
    return name == "granular" ? "sphere" : name;
}

DataColumns sphere_columns() {
    return {.style = "sphere"};
}

DataColumns bpm_columns() {
    return {.style = "bpm/sphere", .type = 2, .diameter = 3, .density = 4, .x = 5, .least = 8};
}

std::optional<DataColumns> hybrid_columns(const std::vector<std::string_view>& styles,
                                          std::string& complaint) {
    DataColumns columns;
    columns.x = 2;
    std::size_t next = 5;
    for (std::size_t k = 1; k < styles.size(); ++k) {
        const std::string style = plain_style(styles[k]);
        if (style == "sphere" || style == "bpm/sphere") {
            columns.diameter = next + (style == "sphere" ? 0 : 1);
            columns.density = columns.diameter + 1;
            columns.least = columns.density + 1;
            return columns;
        }
        const auto* const known = std::find_if(kAdded.begin(), kAdded.end(),
                                               [&](const AddedColumns& one) { return style == one.style; });
        if (known == kAdded.end()) {
            complaint = fmt::format(
                "the columns of \"{}\" before those of sphere are not known; name sphere first in atom_style "
                "hybrid",
                excerpt(styles[k]));
            return std::nullopt;
        }
        next += known->columns;
    }
    complaint = fmt::format("none of its hybrid styles has spheres; {}", kWays);
    return std::nullopt;
}

// Whether each row has a number in a column for which `holds` is true.
bool all_rows(const std::vector<std::vector<std::string_view>>& rows, std::size_t column,
              const std::function<bool(double)>& holds) {
    return std::all_of(rows.begin(), rows.end(), [&](const auto& row) {
        const std::optional<double> number = column < row.size() ? number_in(row[column]) : std::nullopt;
        return number && holds(*number);
    });
}

bool is_whole(double number) {
    return number == static_cast<double>(static_cast<std::int64_t>(number));
}

// Whether the rows can be those of spheres with these columns. Other styles with as many columns have a whole
// number where these have a diameter (the type of full, flags of ellipsoid, line, tri and body).
bool fit(const DataColumns& columns, const std::vector<std::vector<std::string_view>>& rows,
         std::size_t types) {
    const auto above_0 = [](double number) { return number > 0; };
    const auto small_whole = [&](double number) {
        return is_whole(number) && number <= static_cast<double>(std::max<std::size_t>(types, 1));
    };
    return all_rows(rows, columns.diameter, above_0) && all_rows(rows, columns.density, above_0) &&
           !all_rows(rows, columns.diameter, small_whole);
}

std::optional<DataColumns> guess(const std::vector<std::vector<std::string_view>>& rows, std::size_t types,
                                 std::string& complaint) {
    const std::size_t count = rows.empty() ? 0 : rows.front().size();
    for (DataColumns columns : {sphere_columns(), bpm_columns()}) {
        if (count != columns.least && count != columns.least + kImages) continue;
        columns.guessed = true;
        if (fit(columns, rows, types)) return columns;
    }
    complaint = fmt::format(
        "the file does not say its atom_style, and rows of {} columns may be those of several; write the "
        "style "
        "behind the word, as in \"Atoms # sphere\"",
        count);
    return std::nullopt;
}

}  // namespace

DataColumns data_columns(std::string_view style, const std::vector<std::vector<std::string_view>>& rows,
                         std::size_t types, std::string& complaint) {
    const std::vector<std::string_view> words = words_of(style);
    std::optional<DataColumns> columns;
    const std::string first = words.empty() ? std::string() : plain_style(words.front());
    if (words.empty())
        columns = guess(rows, types, complaint);
    else if (first == "hybrid")
        columns = hybrid_columns(words, complaint);
    else if (first == "sphere")
        columns = sphere_columns();
    else if (first == "bpm/sphere")
        columns = bpm_columns();
    else
        complaint =
            fmt::format("a data file of atom_style {}, whose atoms are no spheres with a diameter; {}",
                        excerpt(style), kWays);
    if (!columns) return {};
    if (!words.empty()) columns->style = std::string(style);
    return *columns;
}

}  // namespace grainreel
