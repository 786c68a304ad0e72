#include "engine/grain_table.hpp"

#include <fmt/format.h>
#include <xxhash.h>
#include <array>
#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>

#include "engine/base/csv.hpp"
#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/base/text.hpp"

namespace grainreel {

namespace {

constexpr std::string_view plain_header = "id,type,radius,x,y,z,vx,vy,vz,wx,wy,wz";
constexpr std::string_view orientation_columns = ",qx,qy,qz,qw";
// The header of earlier versions, where `species` counted from 0.
constexpr std::string_view old_header = "id,species,radius,x,y,z,vx,vy,vz,wx,wy,wz";

struct TableForm {
    bool orientation = false;
    const char* species = "type";  // the column's name
    std::int32_t first_species = 1;
};

std::optional<TableForm> form_of(std::string_view header) {
    TableForm form;
    form.orientation = header.ends_with(orientation_columns);
    if (form.orientation) header.remove_suffix(orientation_columns.size());
    if (header == plain_header) return form;
    form.species = "species";
    form.first_species = 0;
    return header == old_header ? std::optional(form) : std::nullopt;
}

void append(fmt::memory_buffer& row, const double* values, int count) {
    for (int i = 0; i < count; ++i) fmt::format_to(std::back_inserter(row), ",{}", values[i]);
}

// The cells of one row, taken one after the other from the left. Messages name the line and the column.
class GrainRow {
  public:
    explicit GrainRow(const CsvRows& rows) : rows_(rows) {}

    double number(const char* column) {
        const CsvCell cell = take(column);
        if (const std::optional<double> value = number_in(cell.text)) return *value;
        const std::optional<double> value = number_in(cell.text, Dialect::programs);
        if (value && !std::isfinite(*value)) reject(fmt::format("`{}` is {}", column, *value));
        refuse(column);
    }

    std::int32_t whole(const char* column) {
        const std::optional<std::int64_t> value = whole_in(take(column).text);
        if (!value || !std::in_range<std::int32_t>(*value)) refuse(column);
        return static_cast<std::int32_t>(*value);
    }

    Vec3 vector(const std::array<const char*, 3>& columns) {
        Vec3 vector;
        for (int i = 0; i < 3; ++i) vector[i] = number(columns[i]);
        return vector;
    }

    void end() const {
        if (taken_ < rows_.cells().size())
            fail(rows_.cells()[taken_].column, "the row has more columns than the header");
    }

    // Throws UserError at the cell that was taken last.
    [[noreturn]] void reject(const std::string& what) const { fail(rows_.cells()[taken_ - 1].column, what); }

  private:
    const CsvCell& take(const char* column) {
        if (taken_ == rows_.cells().size())
            fail(rows_.text().size() + 1, fmt::format("the row ends before `{}`", column));
        return rows_.cells()[taken_++];
    }
    [[noreturn]] void refuse(const char* column) const {
        reject(fmt::format("`{}` is no number for `{}`", rows_.cells()[taken_ - 1].text, column));
    }
    [[noreturn]] void fail(std::size_t column, const std::string& what) const {
        rows_.fail(column, what + "; write the table again from a run");
    }

    const CsvRows& rows_;
    std::size_t taken_ = 0;  // number of cells that were taken
};

void read_grain(GrainRow& row, const TableForm& form, std::unordered_set<std::int32_t>& ids, State& frame) {
    frame.id.push_back(row.whole("id"));
    if (frame.id.back() < 0) row.reject("`id` is negative");
    if (!ids.insert(frame.id.back()).second)
        row.reject(fmt::format("grain {} is here twice", frame.id.back()));
    const auto species = row.whole(form.species);
    if (species < form.first_species)
        row.reject(
            fmt::format("`{}` is {}, but it counts from {}", form.species, species, form.first_species));
    frame.species.push_back(species - form.first_species);
    frame.radius.push_back(row.number("radius"));
    if (frame.radius.back() <= 0) row.reject("`radius` is not positive");
    frame.position.push_back(row.vector({"x", "y", "z"}));
    frame.velocity.push_back(row.vector({"vx", "vy", "vz"}));
    frame.spin.push_back(row.vector({"wx", "wy", "wz"}));
    if (form.orientation) {
        const Vec3 q = row.vector({"qx", "qy", "qz"});
        frame.orientation.emplace_back(row.number("qw"), q.x(), q.y(), q.z());
    }
    row.end();
}

}  // namespace

bool begins_grain_table(std::string_view bytes) {
    std::string line(bytes.substr(0, bytes.find('\n')));
    drop_byte_order_mark(line);
    if (line.ends_with('\r')) line.pop_back();
    return form_of(line).has_value();
}

TableMark write_grain_table(const std::filesystem::path& path, const State& frame) {
    const bool with_orientation = !frame.orientation.empty();
    fmt::memory_buffer text;
    fmt::format_to(std::back_inserter(text), "{}{}\n", plain_header,
                   with_orientation ? orientation_columns : "");
    for (std::size_t i = 0; i < frame.size(); ++i) {
        fmt::format_to(std::back_inserter(text), "{},{},{}", frame.id[i], frame.species[i] + 1,
                       frame.radius[i]);
        append(text, frame.position[i].data(), 3);
        append(text, frame.velocity[i].data(), 3);
        append(text, frame.spin[i].data(), 3);
        if (with_orientation) append(text, frame.orientation[i].coeffs().data(), 4);
        text.push_back('\n');
    }
    replace_file(path, {text.data(), text.size()});
    return mark_of_table(static_cast<std::int64_t>(frame.size()), {text.data(), text.size()});
}

State read_grain_table(const std::filesystem::path& path) {
    std::ifstream file = read_plain(path);
    if (!file) throw UserError("{}: cannot be opened; give the final.csv of a run", path.string());
    CsvRows rows(file, path);
    const std::optional<TableForm> form = rows.next() ? form_of(rows.text()) : std::nullopt;
    if (!form) {
        throw UserError(
            "{}:1:1: not a table of grains; the first line must be `{}`; of a file of another "
            "program, `grainreel export FILE --to grain-table` makes one",
            path.string(), plain_header);
    }
    State frame;
    std::unordered_set<std::int32_t> ids;
    while (rows.next()) {
        GrainRow row(rows);
        read_grain(row, *form, ids, frame);
    }
    if (frame.size() == 0) throw UserError("{}:2:1: no grains in the table", path.string());
    check_as_written(path, static_cast<std::int64_t>(frame.size()));
    return frame;
}

TableMark mark_of_table(std::int64_t grains, std::string_view bytes) {
    return {grains, XXH64(bytes.data(), bytes.size(), 0)};
}

std::optional<TableMark> mark_in_run_json(const std::filesystem::path& run_json) {
    if (!is_plain(run_json)) return std::nullopt;
    std::ifstream file = read_plain(run_json);
    const nlohmann::json document = nlohmann::json::parse(file, nullptr, false);
    if (!document.is_object()) return std::nullopt;
    const auto written = document.find("written");
    if (written == document.end() || !written->is_object()) return std::nullopt;
    const auto table = written->find("final_csv");
    if (table == written->end() || !table->is_object()) return std::nullopt;
    const auto grains = table->find("grains"), sum = table->find("xxh64");
    if (grains == table->end() || !grains->is_number_integer() || sum == table->end() || !sum->is_string())
        return std::nullopt;
    const std::string digits = sum->get<std::string>();
    if (digits.empty() || digits.find_first_not_of("0123456789abcdef") != std::string::npos ||
        digits.size() > 16)
        return std::nullopt;
    return TableMark{grains->get<std::int64_t>(), std::stoull(digits, nullptr, 16)};
}

void check_as_written(const std::filesystem::path& table, std::int64_t grains) {
    if (table.filename() != kFinalTable) return;
    const std::optional<TableMark> written = mark_in_run_json(table.parent_path() / "run.json");
    if (!written) return;
    constexpr const char* advice = "copy it again, or, if you changed it, give it another name";
    if (grains < written->grains)
        throw UserError("{}: was cut off: it has {} of the {} grains that its run wrote; {}", table.string(),
                        grains, written->grains, advice);
    std::ifstream file = read_plain(table);
    const std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (mark_of_table(grains, bytes).checksum != written->checksum)
        throw UserError("{}: is not what its run wrote, by the checksum in the run.json beside it; {}",
                        table.string(), advice);
}

}  // namespace grainreel
