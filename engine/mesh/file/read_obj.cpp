// Reads the vertices and faces of an OBJ file. Faces of more than three corners become fans of triangles.
#include <fmt/format.h>

#include <cmath>

#include "engine/base/number_text.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/mesh/file/mesh_readers.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

class Obj {
  public:
    Obj(const fs::path& file, std::string_view bytes) : file_(file), words_(bytes) {}

    TriangleMesh read() {
        for (std::string_view word = words_.next(); !word.empty(); word = words_.next()) {
            if (word == "v")
                vertex();
            else if (word == "f" || word == "fo")
                face();
            else if (word.starts_with('#'))
                comment_ = true;
            else if (!is_obj_word(word))
                refuse_line(file_, words_.line(),
                            fmt::format("\"{}\" begins no line of an OBJ file", excerpt(word)));
            to_next_line();
        }
        for (const Later& later : later_) check_index(later.index, later.line);
        return std::move(mesh_);
    }

  private:
    // A vertex that a face names before the vertex itself comes in the file.
    struct Later {
        std::int64_t index, line;
    };

    // The next word of this line and of the lines that continue it; empty at their end and before a comment.
    std::string_view next() {
        if (comment_) return {};
        std::string_view word;
        do {
            if (continued_) words_.skip_line();
            word = words_.next_in_line();
            continued_ = word.ends_with('\\');
            if (continued_) word.remove_suffix(1);
        } while (continued_ && word.empty());
        comment_ = word.starts_with('#');
        return comment_ ? std::string_view{} : word;
    }
    void to_next_line() {
        while (!next().empty()) {
        }
        words_.skip_line();
        comment_ = continued_ = false;
    }

    // Reads x y z. A weight, a colour or both may follow and are ignored.
    void vertex() {
        Vec3 place;
        for (int k = 0; k < 3; ++k) {
            const std::string_view word = next();
            const std::optional<double> value = number_in(word);
            if (!value) refuse_line(file_, words_.line(), no_coordinate(word));
            if (std::abs(*value) > largest_coordinate) refuse_line(file_, words_.line(), too_far(*value));
            place[k] = *value;
        }
        mesh_.vertices.push_back(place);
    }

    void face() {
        const std::int64_t line = words_.line();
        std::int32_t first = 0, before = 0;
        std::int64_t corners = 0;
        for (std::string_view word = next(); !word.empty(); word = next(), ++corners) {
            const std::int32_t corner = corner_in(word);
            if (corners == 0) first = corner;
            if (corners >= 2) mesh_.triangles.push_back({first, before, corner});
            before = corner;
        }
        if (corners < 3)
            refuse_line(file_, line, fmt::format("a face with {} corners; it must have three", corners));
    }

    // Reads a corner: "7", "7/2", "7//3", "7/2/3" or "-1". Vertices count from 1 on, or back from the last
    // vertex so far.
    std::int32_t corner_in(std::string_view word) {
        const std::optional<std::int64_t> index = whole_in(word.substr(0, word.find('/')));
        if (!index || *index == 0)
            refuse_line(file_, words_.line(),
                        fmt::format("\"{}\" names no vertex; indices begin at 1", excerpt(word)));
        const auto so_far = static_cast<std::int64_t>(mesh_.vertices.size());
        if (*index < -so_far) check_index(*index, words_.line());
        if (*index > so_far) {
            if (*index > static_cast<std::int64_t>(largest_mesh_file)) check_index(*index, words_.line());
            later_.push_back({*index, words_.line()});
        }
        return static_cast<std::int32_t>(*index < 0 ? so_far + *index : *index - 1);
    }

    void check_index(std::int64_t index, std::int64_t line) const {
        const auto count = static_cast<std::int64_t>(mesh_.vertices.size());
        if (index < -count || index > count)
            refuse_line(file_, line, fmt::format("a face names vertex {}, and there are {}", index, count));
    }

    const fs::path& file_;
    WordReader words_;
    TriangleMesh mesh_;
    std::vector<Later> later_;
    bool comment_ = false, continued_ = false;
};

}  // namespace

TriangleMesh read_obj(const fs::path& file, std::string_view bytes) {
    return Obj(file, bytes).read();
}

}  // namespace grainreel
