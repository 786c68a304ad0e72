#include "render/app/print/paper.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"
#include "engine/lab/chart/gnuplot.hpp"
#include "render/page/embed.hpp"

namespace grainreel {

namespace {

constexpr double inch = 25.4;          // mm
constexpr double points_an_inch = 72;  // points of type in an inch
constexpr double letter = 0.2;         // mm, mean width of a letter of DejaVu Sans, for each point of height

double whole_points(double mm) {
    return std::round(mm / inch * points_an_inch);
}

// The `set terminal` command of gnuplot. gnuplot makes letters and lines for a screen of 96 pixels an inch;
// the factors here bring them to points of print.
std::string terminal(const std::string& form, const Paper& paper) {
    const double wide = whole_points(paper.width_mm), high = whole_points(paper.height_mm());
    constexpr double letters = points_an_inch / 96;
    const std::string font = fmt::format("{},{:.4g}", paper.font, paper.letters);
    if (form == "svg")  // one unit is a point
        return fmt::format("set terminal svg noenhanced size {},{} font '{}' background 'white'", wide, high,
                           font);
    if (form == "png") {
        const double pixel = paper.dpi / points_an_inch;  // pixels in a point
        return fmt::format(
            "set terminal pngcairo noenhanced size {:.0f},{:.0f} font '{}' fontscale {:.4f} linewidth {:.4f} "
            "pointscale {:.4f}",
            paper.width_mm / inch * paper.dpi, paper.height_mm() / inch * paper.dpi, font, letters * pixel,
            pixel, letters * pixel);
    }
    // The size is a little larger, since gnuplot cuts off fractions of a point.
    constexpr double hair = 0.01, line = 2;  // the lines of this terminal are half as wide as asked
    return fmt::format(
        "set terminal pdfcairo noenhanced size {:.6f}in,{:.6f}in font '{}' fontscale {} linewidth {} "
        "pointscale {}",
        (wide + hair) / points_an_inch, (high + hair) / points_an_inch, font, letters, line, letters);
}

}  // namespace

double Paper::height_mm() const {
    constexpr double share = 0.68, most = 100;
    return std::min(share * width_mm, most);
}

PaperLines lines_on(const Paper& paper) {
    const auto letters = [&](double mm) {
        return static_cast<std::size_t>(std::max(10.0, mm / (letter * paper.letters)));
    };
    const std::size_t keys = paper.width_mm < 120 ? 1 : 2;
    return {letters(paper.width_mm - 15), letters(paper.height_mm() - 12),
            letters(paper.width_mm / static_cast<double>(keys) - 20), keys};
}

std::string paper_style() {
    return "set encoding utf8\nset minussign\nset datafile separator ','\nset datafile missing 'NaN'\n"
           "set border 3 lw 0.6 lc rgb '#404040'\nset tics out nomirror scale 0.6 textcolor rgb 'black'\n"
           "set grid lw 0.4 lt 1 lc rgb '#dddddd'\n";
}

std::vector<std::filesystem::path> draw_on_paper(const std::filesystem::path& folder, const std::string& stem,
                                                 const std::string& commands, const std::string& plots,
                                                 const Paper& paper) {
    std::string all = fmt::format("# Draws the table beside it: gnuplot {}.gp\n{}", stem, commands);
    std::vector<std::filesystem::path> files;
    for (const std::string& form : paper.forms) {
        const std::string file = stem + "." + form;
        all += fmt::format("{}\nset output {}\nplot {}\n", terminal(form, paper), gnuplot_text(file), plots);
        files.push_back(folder / file);
    }
    all += "unset output\n";
    replace_file(folder / (stem + ".gp"), all);
    if (!run_gnuplot(folder, stem + ".gp"))
        throw RunError(
            "{}: gnuplot is missing or failed, so there are tables but no charts; install "
            "gnuplot-nox and give the same command again",
            (folder / (stem + ".gp")).string());
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (paper.forms[i] == "svg") say_size_in_mm(files[i], paper.width_mm);
        if (paper.forms[i] == "png") say_dots(files[i], paper.dpi);
    }
    return files;
}

namespace {

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

RunError not_gnuplots(const std::filesystem::path& file) {
    return RunError("{}: is not as gnuplot writes it; is this version of gnuplot known to work?",
                    file.string());
}

// The CRC of PNG's chunks (ISO 3309; PNG specification, annex D).
std::uint32_t crc(std::string_view bytes) {
    std::uint32_t sum = 0xffffffffu;
    for (const char byte : bytes) {
        sum ^= static_cast<unsigned char>(byte);
        for (int bit = 0; bit < 8; ++bit) sum = (sum & 1u) != 0 ? 0xedb88320u ^ (sum >> 1u) : sum >> 1u;
    }
    return sum ^ 0xffffffffu;
}

std::string big_endian(std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>((number >> shift) & 0xffu);
    return bytes;
}

}  // namespace

void say_size_in_mm(const std::filesystem::path& svg, double width_mm) {
    std::string text = bytes_of(svg);
    constexpr std::string_view size_begins = " width=\"";
    const std::size_t begin = text.find(size_begins);
    unsigned wide = 0, high = 0;
    int length = 0;
    if (begin == std::string::npos ||
        std::sscanf(text.c_str() + begin, " width=\"%u\" height=\"%u\"%n", &wide, &high, &length) != 2 ||
        length == 0 || wide == 0)
        throw not_gnuplots(svg);
    text.replace(begin, static_cast<std::size_t>(length),
                 fmt::format(" width=\"{:.6g}mm\" height=\"{:.6g}mm\"", width_mm, width_mm * high / wide));
    constexpr std::string_view named = "font-family=\"DejaVu Sans\"",
                               any = "font-family=\"DejaVu Sans, Verdana, Arial, sans-serif\"";
    for (std::size_t place = text.find(named); place != std::string::npos;
         place = text.find(named, place + any.size()))
        text.replace(place, named.size(), any);
    replace_file(svg, text);
}

void say_title(const std::filesystem::path& svg, const std::string& title) {
    static const std::string theirs = "<title>Gnuplot</title>";
    std::string bytes = bytes_of(svg);
    const std::size_t at = bytes.find(theirs);
    if (at == std::string::npos) return;
    replace_file(svg, bytes.replace(at, theirs.size(), "<title>" + html_text(title) + "</title>"));
}

void say_dots(const std::filesystem::path& png, double dpi) {
    std::string bytes = bytes_of(png);
    constexpr std::size_t behind_head = 33;  // bytes of the signature and the chunk IHDR
    constexpr double metre = 1000;           // mm
    if (bytes.size() < behind_head || bytes.compare(12, 4, "IHDR") != 0) throw not_gnuplots(png);
    const std::string dots = big_endian(static_cast<std::uint32_t>(dpi * metre / inch + 0.5));
    const std::string chunk = "pHYs" + dots + dots + '\1';  // dots a metre, in both directions
    constexpr std::uint32_t length = 9;
    bytes.insert(behind_head, big_endian(length) + chunk + big_endian(crc(chunk)));
    replace_file(png, bytes);
}

}  // namespace grainreel
