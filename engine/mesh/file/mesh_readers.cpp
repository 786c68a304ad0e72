#include "engine/mesh/file/mesh_readers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

#include "engine/base/error.hpp"
#include "engine/base/number_text.hpp"
#include "engine/base/system/file_state.hpp"
#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"

namespace grainreel {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view shipped_prefix = "shipped:";
constexpr const char* what_to_give = "give the path of an STL, OBJ or PLY file";

void check_kind(const fs::path& file) {
    std::error_code ignored;
    switch (fs::status(file, ignored).type()) {
        case fs::file_type::regular:
            return;
        case fs::file_type::directory:
            refuse_file(file, fmt::format("this is a folder; {}", what_to_give));
        case fs::file_type::not_found:
            refuse_file(file, fmt::format("there is no such file; {}", what_to_give));
        case fs::file_type::fifo:
            refuse_file(file, "this is a pipe; give the path of an ordinary file");
        case fs::file_type::none:
        case fs::file_type::unknown:
            refuse_file(file, "cannot be read; check its permissions");
        default:
            refuse_file(file, fmt::format("this is a device; {}", what_to_give));
    }
}

struct Open {
    int file;
    ~Open() {
        if (file >= 0) ::close(file);
    }
};

}  // namespace

std::string mesh_bytes(const fs::path& file) {
    if (const auto shipped = shipped_mesh(file)) return std::string(*shipped);
    check_kind(file);
    const Open open{::open(file.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)};
    struct stat about {};
    if (open.file < 0 || ::fstat(open.file, &about) != 0 || !S_ISREG(about.st_mode))
        refuse_file(file, "cannot be read; check its permissions");
    FilesRead::note(file, state_of(about));
    const auto size = static_cast<std::uint64_t>(about.st_size);
    if (size == 0) refuse_file(file, fmt::format("is empty; {}", what_to_give));
    if (size > largest_mesh_file) refuse_file(file, "is larger than 2 GiB; give a mesh of fewer triangles");
    std::string bytes(size, '\0');
    std::size_t done = 0;
    while (done < bytes.size()) {
        const ssize_t got = ::read(open.file, bytes.data() + done, bytes.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) refuse_file(file, "cannot be read; check its permissions");
        if (got == 0) refuse_file(file, "became shorter while it was read; try again when it is whole");
        done += static_cast<std::size_t>(got);
    }
    return bytes;
}

bool is_shipped_mesh(const std::filesystem::path& file) {
    return file.filename().string().starts_with(shipped_prefix);
}

std::optional<std::string_view> shipped_mesh(const std::filesystem::path& file) {
    if (!is_shipped_mesh(file)) return std::nullopt;
    const std::string name = file.filename().string().substr(shipped_prefix.size());
    std::vector<std::string> names;
    for (const ShippedMesh& mesh : shipped_meshes()) {
        if (mesh.name == name) return mesh.bytes;
        names.push_back(mesh.name);
    }
    throw UserError("{}{}: the program has no such mesh; it has {}", shipped_prefix, excerpt(name),
                    fmt::join(names, ", "));
}

namespace {

constexpr const char* known = "give an STL, OBJ or PLY file";

// The count of triangles in a file that is taken as a binary STL, and the size that the file must have then;
// both are 0 if the file is too short.
struct BinaryStl {
    std::uint64_t triangles = 0, bytes = 0;
};

BinaryStl as_binary_stl(std::string_view bytes) {
    if (bytes.size() < 84) return {};
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return {count, 84 + 50 * std::uint64_t{count}};
}

// Whether the beginning of a file is text, which has no zero bytes. A binary STL mostly has some, in the
// attributes of its facets.
bool is_text(std::string_view bytes) {
    return bytes.substr(0, 4096).find('\0') == std::string_view::npos;
}

std::string_view first_word(std::string_view bytes) {
    WordReader words(bytes);
    std::string_view word = words.next();
    while (word.starts_with('#')) {
        words.skip_line();
        word = words.next();
    }
    return word;
}

[[noreturn]] void refuse_binary(const fs::path& file, std::string_view bytes, bool solid) {
    if (bytes.size() < 84)
        refuse_file(file, fmt::format("is no mesh: {} bytes that are no text; {}", bytes.size(), known));
    const BinaryStl stl = as_binary_stl(bytes);
    const std::string sizes = fmt::format("says {} triangles, which take {} bytes; the file has {}",
                                          stl.triangles, stl.bytes, bytes.size());
    if (solid) refuse_byte(file, 80, fmt::format("this binary STL {}; export it again", sizes));
    refuse_byte(file, 80,
                fmt::format("is no mesh, or a damaged one: as a binary STL it {}; {}", sizes, known));
}

}  // namespace

const char* name_of(MeshFormat format) {
    switch (format) {
        case MeshFormat::binary_stl:
            return "binary STL";
        case MeshFormat::ascii_stl:
            return "ASCII STL";
        case MeshFormat::obj:
            return "OBJ";
        case MeshFormat::ply:
            return "PLY";
    }
    return "";
}

MeshFormat format_of(const fs::path& file, std::string_view bytes) {
    if (bytes.size() > 3 && bytes.starts_with("ply") && std::strchr("\r\n \t", bytes[3]) != nullptr &&
        bytes[3] != '\0')
        return MeshFormat::ply;
    const BinaryStl stl = as_binary_stl(bytes);
    if (stl.bytes == bytes.size()) return MeshFormat::binary_stl;
    const std::string_view word = first_word(bytes);
    const bool solid = same_word(word, "solid");
    if (!is_text(bytes)) refuse_binary(file, bytes, solid);
    if (solid) return MeshFormat::ascii_stl;
    if (is_obj_word(word)) return MeshFormat::obj;
    refuse_line(file, 1, fmt::format("this text is no mesh: neither STL, OBJ nor PLY; {}", known));
}

TriangleMesh read_mesh(MeshFormat format, const fs::path& file, std::string_view bytes) {
    switch (format) {
        case MeshFormat::binary_stl:
            return read_binary_stl(file, bytes);
        case MeshFormat::ascii_stl:
            return read_ascii_stl(file, bytes);
        case MeshFormat::obj:
            return read_obj(file, bytes);
        case MeshFormat::ply:
            return read_ply(file, bytes);
    }
    return {};
}

std::string too_far(double coordinate) {
    return fmt::format("a coordinate of {:g}; the largest that is taken is {:g}", coordinate,
                       largest_coordinate);
}

std::string no_coordinate(std::string_view word) {
    return no_number(word) + (word.empty() ? "" : "; correct it, or export the mesh again");
}

}  // namespace grainreel
