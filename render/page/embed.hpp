// Tools by which a page is put together: text and data inside HTML, bytes as text, packed bytes, the HTML
// files that the build puts into the program, and the progress of making a page. Nothing here knows about
// runs.
#pragma once

#include <fmt/format.h>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace grainreel {

// Escapes text for HTML, so that all its characters are shown as they are. Control characters other than line
// ends and tabs are replaced by U+FFFD.
std::string html_text(std::string_view text);

// Makes JSON safe inside a <script> element: < is written as \u003c, so that nothing in it can end the
// element.
std::string json_in_html(std::string json);

// A relative link to a file of that name: percent-encoded, never a scheme or a path.
std::string file_link(std::string_view name);

// The template with each {{name}} replaced by its text. Names inside the inserted text are not replaced. A
// name of the template without a text is a bug and fails GRAINREEL_CHECK.
std::string filled(std::string_view page, const std::vector<std::pair<std::string_view, std::string>>& texts);

// Base64 of RFC 4648 with padding, in one line. None of its characters has a meaning in HTML.
std::string base64(std::span<const std::uint8_t> bytes);

// Puts bytes into an element that no browser runs or shows; empty without bytes.
std::string blob(const std::string& id, std::span<const std::uint8_t> bytes);

// Reads a file of moderate size. Throws RunError when it cannot be read, or has more bytes than a page may
// have.
std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path);

// Packs bytes as browsers unpack them: in zlib's format (RFC 1950), which DecompressionStream calls
// "deflate".
std::vector<std::uint8_t> zlib_packed(std::span<const std::uint8_t> bytes);

// The files of render/page/html, which the build puts into the program. Page, parts and style are contained
// unchanged. The scripts are joined by the build (embed_page.cmake), with uPlot first.
struct PageFiles {
    std::string_view page, body, variant, bed, charts, fields, live, style;
    std::string_view script_before, mesh_script, script_after;

    // The whole script of a page. Only scenes with meshes need the part that draws meshes.
    std::string script(bool meshes) const {
        return fmt::format("{}{}{}", script_before, meshes ? mesh_script : "", script_after);
    }
};
const PageFiles& page_files();

// The functions that make a page call this with the share of the work that is done. If it returns false, they
// stop.
using PageProgress = std::function<bool(double)>;

// Thrown when progress returned false; write_report() catches it.
struct PageStopped {};

inline const PageProgress kNoPageProgress = [](double) { return true; };

inline void go_on_or_stop(const PageProgress& progress, double share) {
    if (!progress(share)) throw PageStopped();
}

}  // namespace grainreel
