#include "render/film/codec/png.hpp"

#include <libdeflate.h>
#include <png.h>
#include <cerrno>
#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <memory>
#include <utility>

#include "engine/base/error.hpp"
#include "engine/base/plain_file.hpp"

namespace grainreel {

namespace {

// Level of libdeflate, which is used with PNG's filter Up. It takes 34 ms of processor time a frame and gives
// 395 kB; level 2 takes 36 ms and gives 386 kB. libpng with zlib's level 2 and the filter Sub takes 44 ms and
// gives 445 kB. (Medians over frames of the default film at 1080p.)
constexpr int level = 1;

struct FileCloser {
    void operator()(std::FILE* file) const { std::fclose(file); }
};
using FilePtr = std::unique_ptr<std::FILE, FileCloser>;

// What a libpng callback needs to know. A callback must not throw, since exceptions cannot pass through C.
struct PngTarget {
    std::FILE* file = nullptr;
    std::string error;
};

void on_write(png_structp png, png_bytep data, std::size_t size) {
    const PngTarget& target = *static_cast<PngTarget*>(png_get_io_ptr(png));
    if (std::fwrite(data, 1, size, target.file) != size) png_error(png, std::strerror(errno));
}

void on_flush(png_structp) {}

[[noreturn]] void on_error(png_structp png, png_const_charp message) {
    static_cast<PngTarget*>(png_get_error_ptr(png))->error = message;
    png_longjmp(png, 1);
}

void on_warning(png_structp, png_const_charp) {}

constexpr std::size_t rgb = 3, rgba = 4;  // bytes a pixel

// The rows after PNG's filter Up: each row is its difference to the row above, behind the filter's number.
std::vector<std::uint8_t> filtered(const Picture& picture, std::size_t channels) {
    constexpr std::uint8_t up = 2;
    const auto width = static_cast<std::size_t>(picture.width);
    const std::size_t length = channels * width;
    std::vector<std::uint8_t> rows(static_cast<std::size_t>(picture.height) * (length + 1));
    std::vector<std::uint8_t> above(length, 0), row(length);
    std::uint8_t* out = rows.data();
    for (int y = 0; y < picture.height; ++y) {
        const std::uint8_t* pixel = picture.pixel(0, y);
        for (std::size_t x = 0; x < width; ++x) std::memcpy(&row[channels * x], pixel + rgba * x, channels);
        *out++ = up;
        for (std::size_t i = 0; i < length; ++i) out[i] = static_cast<std::uint8_t>(row[i] - above[i]);
        out += length;
        std::swap(row, above);
    }
    return rows;
}

struct FreeCompressor {
    void operator()(libdeflate_compressor* compressor) const { libdeflate_free_compressor(compressor); }
};

// The compressed bytes; empty when there is no memory.
std::vector<std::uint8_t> compressed(const std::vector<std::uint8_t>& bytes) {
    const std::unique_ptr<libdeflate_compressor, FreeCompressor> compressor(
        libdeflate_alloc_compressor(level));
    if (!compressor) return {};
    std::vector<std::uint8_t> out(libdeflate_zlib_compress_bound(compressor.get(), bytes.size()));
    out.resize(
        libdeflate_zlib_compress(compressor.get(), bytes.data(), bytes.size(), out.data(), out.size()));
    return out;
}

class PngWriter {
  public:
    explicit PngWriter(PngTarget& target)
        : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, &target, on_error, on_warning)),
          info_(png_ ? png_create_info_struct(png_) : nullptr) {
        if (png_) png_set_write_fn(png_, &target, on_write, on_flush);
    }
    ~PngWriter() { png_destroy_write_struct(&png_, &info_); }
    PngWriter(const PngWriter&) = delete;
    PngWriter& operator=(const PngWriter&) = delete;

    // Writes the file with `data` as its one IDAT chunk. Returns false after an error. Nothing in this
    // function may need a destructor, since libpng leaves it by longjmp.
    bool write(const Picture& picture, bool alpha, double dpi, const std::vector<std::uint8_t>& data,
               png_textp texts, int text_count) {
        if (!info_ || data.empty()) return false;
        if (setjmp(png_jmpbuf(png_))) return false;
        png_set_IHDR(png_, info_, static_cast<png_uint_32>(picture.width),
                     static_cast<png_uint_32>(picture.height), 8,
                     alpha ? PNG_COLOR_TYPE_RGB_ALPHA : PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                     PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
        png_set_sRGB(png_, info_, PNG_sRGB_INTENT_PERCEPTUAL);
        constexpr double inch = 0.0254;                                // m
        const auto dots = static_cast<png_uint_32>(dpi / inch + 0.5);  // pixels a metre
        if (dots > 0) png_set_pHYs(png_, info_, dots, dots, PNG_RESOLUTION_METER);
        png_set_text(png_, info_, texts, text_count);
        png_write_info(png_, info_);
        png_write_chunk(png_, reinterpret_cast<png_const_bytep>("IDAT"), data.data(), data.size());
        png_write_chunk(png_, reinterpret_cast<png_const_bytep>("IEND"), nullptr, 0);
        return true;
    }

  private:
    png_structp png_;
    png_infop info_;
};

std::vector<png_text> png_texts(const std::vector<PngText>& texts) {
    std::vector<png_text> chunks;
    for (const PngText& text : texts) {
        png_text chunk{};
        // Texts are iTXt chunks, since Γ is not Latin-1. libpng takes non-const pointers but only reads.
        chunk.compression = PNG_ITXT_COMPRESSION_NONE;
        chunk.key = const_cast<char*>(text.keyword.c_str());
        chunk.text = const_cast<char*>(text.text.c_str());
        chunk.itxt_length = text.text.size();
        chunks.push_back(chunk);
    }
    return chunks;
}

// Returns an empty string, or why writing failed.
std::string write_file(const std::filesystem::path& path, const Picture& picture,
                       const std::vector<PngText>& texts, bool alpha, double dpi) {
    const int made = make_plain(path);
    FilePtr file(made < 0 ? nullptr : ::fdopen(made, "wb"));
    if (!file) return std::strerror(errno);
    PngTarget target{file.get(), {}};
    std::vector<png_text> chunks = png_texts(texts);
    const std::vector<std::uint8_t> data = compressed(filtered(picture, alpha ? rgba : rgb));
    PngWriter writer(target);
    if (!writer.write(picture, alpha, dpi, data, chunks.data(), static_cast<int>(chunks.size())))
        return target.error.empty() ? "no memory" : target.error;
    return std::fclose(file.release()) == 0 ? "" : std::strerror(errno);
}

}  // namespace

void write_png(const std::filesystem::path& path, const Picture& picture, const std::vector<PngText>& texts,
               bool alpha, double dpi) {
    const std::filesystem::path part = path.string() + ".part";
    std::string reason = write_file(part, picture, texts, alpha, dpi);
    std::error_code renamed;
    if (reason.empty()) {
        std::filesystem::rename(part, path, renamed);
        if (renamed) reason = renamed.message();
    }
    if (reason.empty()) return;
    std::error_code ignored;
    std::filesystem::remove(part, ignored);
    throw RunError("{}: cannot write the picture: {}", path.string(), reason);
}

}  // namespace grainreel
