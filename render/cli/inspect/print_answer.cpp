#include "render/cli/inspect/print_answer.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "engine/scene/film/grain_values.hpp"

namespace grainreel {
namespace {

using Json = nlohmann::ordered_json;

// Of UTF-8: bytes that do not go on with the character before them.
std::size_t characters(const std::string& text) {
    return static_cast<std::size_t>(
        std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

std::string si_unit(Dimension dimension) {
    return dimension == Dimension::number ? "" : text_of(dimension).unit;
}

// That of the column's largest number.
std::string unit_for_people(const AnswerTable& table, std::size_t column) {
    const Dimension dimension = table.columns[column].dimension;
    if (dimension == Dimension::number) return "";
    double most = 0;
    for (const auto& row : table.rows)
        if (const double* value = std::get_if<double>(&row[column]))
            if (std::isfinite(*value)) most = std::max(most, std::abs(*value));
    return fitting_unit(most, dimension);
}

std::string for_people(const AnswerCell& cell, double unit) {
    if (const auto* words = std::get_if<std::string>(&cell)) return *words;
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
    const double* value = std::get_if<double>(&cell);
    return value && std::isfinite(*value) ? fmt::format("{:.4g}", *value / unit) : "-";
}

bool is_words(const AnswerTable& table, std::size_t column) {
    return std::any_of(table.rows.begin(), table.rows.end(),
                       [&](const auto& row) { return std::holds_alternative<std::string>(row[column]); });
}

struct Block {
    std::vector<std::string> lines;  // the head first
    std::size_t width = 0;           // characters
    bool left = false;               // words stand left, numbers right
};

Block block_of(const AnswerTable& table, std::size_t column) {
    const std::string unit = unit_for_people(table, column);
    const double size = unit_size(unit, table.columns[column].dimension);
    Block block;
    block.left = is_words(table, column);
    block.lines.push_back(table.columns[column].name + (unit.empty() ? "" : " (" + unit + ")"));
    for (const auto& row : table.rows) block.lines.push_back(for_people(row[column], size));
    for (const std::string& line : block.lines) block.width = std::max(block.width, characters(line));
    return block;
}

std::string padded(const std::string& text, const Block& block) {
    const std::string space(block.width - characters(text), ' ');
    return block.left ? text + space : space + text;
}

std::string wide_table(const AnswerTable& table) {
    std::vector<Block> blocks;
    for (std::size_t k = 0; k < table.columns.size(); ++k) blocks.push_back(block_of(table, k));
    std::string text;
    for (std::size_t row = 0; row <= table.rows.size(); ++row) {
        std::string line;
        for (const Block& block : blocks)
            line += (line.empty() ? "  " : "   ") + padded(block.lines[row], block);
        line.erase(line.find_last_not_of(' ') + 1);
        text += line + "\n";
    }
    return text;
}

// A single row of many columns: a line each.
std::string tall_table(const AnswerTable& table) {
    std::size_t width = 0;
    for (const AnswerColumn& column : table.columns) width = std::max(width, column.name.size());
    std::string text;
    for (std::size_t k = 0; k < table.columns.size(); ++k) {
        const std::string unit = unit_for_people(table, k);
        const AnswerColumn& column = table.columns[k];
        text += fmt::format("  {:<{}}  {}{}{}{}\n", column.name, width,
                            for_people(table.rows[0][k], unit_size(unit, column.dimension)),
                            unit.empty() ? "" : " " + unit, column.about.empty() ? "" : "   ", column.about);
    }
    return text;
}

Json json_cell(const AnswerCell& cell) {
    if (const auto* words = std::get_if<std::string>(&cell)) return *words;
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return *count;
    const double* value = std::get_if<double>(&cell);
    return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json json_table(const AnswerTable& table) {
    Json columns = Json::array(), rows = Json::array();
    for (const AnswerColumn& column : table.columns)
        columns.push_back(
            {{"name", column.name}, {"unit", si_unit(column.dimension)}, {"about", column.about}});
    for (const auto& row : table.rows) {
        Json cells = Json::array();
        for (const AnswerCell& cell : row) cells.push_back(json_cell(cell));
        rows.push_back(std::move(cells));
    }
    return {{"title", table.title}, {"columns", std::move(columns)}, {"rows", std::move(rows)}};
}

std::string csv_words(const std::string& words) {
    if (words.find_first_of(",\"\n") == std::string::npos) return words;
    std::string quoted = "\"";
    for (const char c : words) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::string csv_cell(const AnswerCell& cell) {
    if (const auto* words = std::get_if<std::string>(&cell)) return csv_words(*words);
    if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
    const double* value = std::get_if<double>(&cell);
    return value && std::isfinite(*value) ? fmt::format("{}", *value) : "";
}

}  // namespace

std::string text_of(const Answer& answer) {
    constexpr std::size_t widest = 7;  // columns of a single row that stand side by side
    std::string text;
    for (const AnswerTable& table : answer.tables) {
        text += (text.empty() ? "" : "\n") + table.title + "\n";
        if (table.rows.empty()) {
            text += "  nothing\n";
        } else {
            text += table.rows.size() == 1 && table.columns.size() > widest ? tall_table(table)
                                                                            : wide_table(table);
        }
    }
    for (const std::string& note : answer.notes) text += "\n" + note + "\n";
    return text;
}

std::string json_of(const Answer& answer) {
    Json tables = Json::object();
    for (const AnswerTable& table : answer.tables) tables[table.name] = json_table(table);
    return Json{{"tables", std::move(tables)}, {"notes", answer.notes}}.dump(2) + "\n";
}

std::string csv_of(const Answer& answer) {
    std::string text;
    for (const AnswerTable& table : answer.tables) {
        if (!text.empty()) text += "\n";
        std::string head;
        for (const AnswerColumn& column : table.columns) {
            const std::string unit = si_unit(column.dimension);
            head +=
                (head.empty() ? "" : ",") + csv_words(column.name + (unit.empty() ? "" : " (" + unit + ")"));
        }
        text += head + "\n";
        for (const auto& row : table.rows) {
            for (std::size_t k = 0; k < row.size(); ++k) text += (k > 0 ? "," : "") + csv_cell(row[k]);
            text += "\n";
        }
    }
    return text;
}

}  // namespace grainreel
