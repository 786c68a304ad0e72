#include "render/app/print/curve.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace grainreel {
namespace {

std::string cell(const std::string& text) {
    std::string quoted = "\"";
    for (const char c : text) {
        if (c == '"') quoted += '"';
        quoted += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return quoted + "\"";
}

// The rows that are drawn.
std::vector<std::size_t> shown_rows(const std::vector<double>& y) {
    std::vector<std::size_t> rows;
    const std::size_t parts = kMostCurvePoints / 4, count = y.size();
    if (count <= kMostCurvePoints) {
        for (std::size_t i = 0; i < count; ++i) rows.push_back(i);
        return rows;
    }
    const auto less = [&](std::size_t a, std::size_t b) { return y[a] < y[b]; };
    for (std::size_t part = 0; part < parts; ++part) {
        const std::size_t from = part * count / parts, to = (part + 1) * count / parts;
        std::vector<std::size_t> some, kept{from, to - 1};
        for (std::size_t i = from; i < to; ++i) std::isfinite(y[i]) ? some.push_back(i) : kept.push_back(i);
        if (!some.empty()) {
            const auto [low, high] = std::minmax_element(some.begin(), some.end(), less);
            kept.insert(kept.end(), {*low, *high});
        }
        std::sort(kept.begin(), kept.end());
        kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
        rows.insert(rows.end(), kept.begin(), kept.end());
    }
    return rows;
}

}  // namespace

std::string curve_table(std::size_t number, const std::vector<double>& x, const std::vector<double>& y,
                        const std::string& name) {
    std::string text;
    const std::string last = name.empty() ? "" : "," + cell(name);
    bool gap = true;  // no second empty line, which would begin another block
    for (const std::size_t row : shown_rows(y)) {
        const bool there = std::isfinite(x[row]) && std::isfinite(y[row]);
        if (there) text += fmt::format("{},{},{}{}\n", number, x[row], y[row], last);
        if (!there && !gap) text += "\n";
        gap = !there;
    }
    return text;
}

}  // namespace grainreel
