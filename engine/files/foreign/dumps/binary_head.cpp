#include "engine/files/foreign/dumps/binary_head.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "engine/base/text.hpp"
#include "engine/base/word_reader.hpp"
#include "engine/files/foreign/dumps/dump_parts.hpp"

namespace grainreel {

namespace {

constexpr std::int32_t most_columns = 100000;
constexpr std::int32_t longest_text = 1 << 20;  // bytes
constexpr std::int32_t most_chunks = 1 << 24;   // each process writes one

// Reads the fields of a head in the order in which LAMMPS writes them.
class HeadReader {
  public:
    HeadReader(BinaryReader& in, const BinaryForm& form, BinaryHead& head)
        : in_(in), form_(form), head_(head) {}

    BinaryEnd read() {
        head_.place = in_.place();
        const bool all = form_.magic ? magic() && counts() && box() && names() && chunks()
                                     : counts() && box() && columns() && chunks();
        if (all) return BinaryEnd::whole;
        if (!complaint_.empty()) return BinaryEnd::damaged;
        return in_.place() > head_.place ? BinaryEnd::cut : BinaryEnd::nothing;
    }

    const std::string& complaint() const { return complaint_; }

  private:
    bool wrong(std::string what) {
        complaint_ = std::move(what);
        return false;
    }

    template <class Number>
    bool number(Number& to) {
        return in_.read(to);
    }

    bool magic() {
        std::int64_t size = 0;
        std::int32_t order = 0;
        std::string word;
        if (!number(size)) return false;
        if (size < -20 || size >= 0) return wrong("no frame of a binary dump begins here");
        if (!in_.read_text(word, static_cast<std::size_t>(-size))) return false;
        if (word != "DUMPATOM" && word != "DUMPCUSTOM")
            return wrong(
                fmt::format("a binary dump of the style \"{}\" begins here, which is not read; those of "
                            "dump atom and dump custom are",
                            excerpt(word)));
        if (!number(order) || !number(revision_)) return false;
        if (order != 1) return wrong("the word for the byte order is damaged");
        if (revision_ < 1 || revision_ > 2)
            return wrong(fmt::format("revision {} of binary dumps is not read; up to 2 is", revision_));
        return true;
    }

    bool wide(std::int64_t& to) {
        if (!form_.narrow) return number(to);
        std::int32_t narrow = 0;
        if (!number(narrow)) return false;
        to = narrow;
        return true;
    }

    bool counts() {
        if (!wide(head_.step) || !wide(head_.rows)) return false;
        if (head_.step < 0) return wrong(fmt::format("a frame of the step {}", head_.step));
        if (head_.rows < 0) return wrong(fmt::format("a frame of {} grains", head_.rows));
        return true;
    }

    bool box() {
        std::int32_t tilted = form_.box == BinaryForm::Box::bare_tilted ? 1 : 0;
        std::array<bool, 3> periodic{};
        if (form_.box == BinaryForm::Box::flags && (!number(tilted) || !flags(periodic))) return false;
        if (!complaint_.empty()) return false;
        if (tilted < 0 || tilted > 2) return wrong("the box is damaged");
        return tilted == 2 ? general_box(periodic) : bounds(tilted == 1, periodic);
    }

    bool flags(std::array<bool, 3>& periodic) {
        for (std::size_t k = 0; k < 6; ++k) {
            std::int32_t flag = 0;
            if (!number(flag)) return false;
            if (flag < 0 || flag > 3) return wrong("the flags of the box are damaged");
            periodic[k / 2] = flag == 0 && (k % 2 == 0 || periodic[k / 2]);
        }
        return true;
    }

    // Reads a length of the box, which must have a usual size. Wrong bytes, read as a double, mostly do not.
    bool length(double& to) {
        if (!number(to)) return false;
        constexpr double least = 1e-30, most = 1e30;
        const double size = std::abs(to);
        if (std::isfinite(to) && (size == 0 || (size > least && size < most))) return true;
        return wrong("the numbers of the box are damaged");
    }

    bool bounds(bool tilted, const std::array<bool, 3>& periodic) {
        BoxBounds bounds;
        bounds.periodic = periodic;
        for (std::size_t k = 0; k < 3; ++k)
            if (!length(bounds.low[k]) || !length(bounds.high[k])) return false;
        if (tilted && (!length(bounds.xy) || !length(bounds.xz) || !length(bounds.yz))) return false;
        for (std::size_t k = 0; k < 3; ++k)
            if (bounds.high[k] < bounds.low[k])
                return head_.rows == 0 ||
                       // This happens when a box without grains is shrink-wrapped.
                       wrong("the box ends before it begins");
        head_.box = cell_of(bounds);
        return true;
    }

    bool general_box(const std::array<bool, 3>& periodic) {
        WorldCell cell;
        cell.periodic = periodic;
        for (Vec3& edge : cell.edges)
            for (Eigen::Index k = 0; k < 3; ++k)
                if (!length(edge[k])) return false;
        for (Eigen::Index k = 0; k < 3; ++k)
            if (!length(cell.origin[k])) return false;
        head_.box = cell;
        return true;
    }

    bool columns() {
        if (!number(head_.columns)) return false;
        if (head_.columns < 1 || head_.columns > most_columns)
            return wrong(fmt::format("a frame of {} columns", head_.columns));
        return true;
    }

    bool text(std::string& to) {
        std::int32_t size = 0;
        if (!number(size)) return false;
        if (size < 0 || size > longest_text) return wrong(fmt::format("a text of {} bytes", size));
        return in_.read_text(to, static_cast<std::size_t>(size));
    }

    bool names() {
        if (!columns()) return false;
        if (revision_ < 2) return true;
        char timed = 0;
        double time = 0;
        std::string all;
        if (!text(head_.units) || !number(timed)) return false;
        if (timed != 0) {
            if (!number(time)) return false;
            head_.time = time;
        }
        if (!text(all)) return false;
        WordReader words(all);
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            head_.names.emplace_back(word);
        if (head_.names.size() != static_cast<std::size_t>(head_.columns))
            return wrong(fmt::format("{} columns have {} names", head_.columns, head_.names.size()));
        return true;
    }

    bool chunks() {
        if (!number(head_.chunks)) return false;
        if (head_.chunks < 0 || head_.chunks > most_chunks)
            return wrong(fmt::format("a frame in {} parts", head_.chunks));
        head_.data = in_.place();
        return true;
    }

    BinaryReader& in_;
    const BinaryForm& form_;
    BinaryHead& head_;
    std::string complaint_;
    std::int32_t revision_ = 0;
};

class MemoryBytes : public ByteSource {
  public:
    explicit MemoryBytes(std::string_view bytes) : bytes_(bytes) {}
    std::size_t read(char* to, std::size_t size) override {
        const std::size_t got = std::min(size, bytes_.size() - place_);
        if (got > 0) std::memcpy(to, bytes_.data() + place_, got);
        place_ += got;
        return got;
    }
    bool cut_off() const override { return false; }
    void seek(std::uint64_t place) override {
        place_ = static_cast<std::size_t>(std::min<std::uint64_t>(place, bytes_.size()));
    }

  private:
    std::string_view bytes_;
    std::size_t place_ = 0;
};

// Whether the bytes begin with a head of that form, and the size of the first chunk fits this head.
bool makes_sense(std::string_view bytes, const BinaryForm& form) {
    MemoryBytes memory(bytes);
    BinaryReader in(memory, form.swapped);
    BinaryHead head;
    std::string complaint;
    if (read_binary_head(in, form, head, complaint) != BinaryEnd::whole) return false;
    constexpr std::int64_t most_rows = std::int64_t{1} << 40;
    if (head.chunks < 1) return head.rows == 0;
    std::int32_t size = 0;
    return head.rows < most_rows && in.read(size) && size >= 0 && size % head.columns == 0 &&
           size / head.columns <= head.rows;
}

}  // namespace

bool BinaryReader::read_bytes(void* to, std::size_t size) {
    auto* const bytes = static_cast<char*>(to);
    const std::size_t got = source_.read(bytes, size);
    place_ += got;
    if (got < size) return false;
    if (swapped_) std::reverse(bytes, bytes + size);
    return true;
}

bool BinaryReader::read_text(std::string& to, std::size_t size) {
    to.resize(size);
    const std::size_t got = source_.read(to.data(), size);
    place_ += got;
    return got == size;
}

std::size_t BinaryReader::read(double* to, std::size_t count) {
    const std::size_t bytes = source_.read(reinterpret_cast<char*>(to), count * sizeof(double));
    place_ += bytes;
    const std::size_t got = bytes / sizeof(double);
    if (swapped_)
        for (std::size_t k = 0; k < got; ++k)
            to[k] = std::bit_cast<double>(__builtin_bswap64(std::bit_cast<std::uint64_t>(to[k])));
    return got;
}

bool BinaryReader::pass(std::uint64_t bytes) {
    if (bytes == 0) return true;
    // seek() also works beyond the end of a file, so the last byte is read to see that it exists.
    char last = 0;
    source_.seek(place_ + bytes - 1);
    place_ += bytes - 1;
    return read(last);
}

void BinaryReader::seek(std::uint64_t place) {
    source_.seek(place);
    place_ = place;
}

BinaryEnd read_binary_head(BinaryReader& in, const BinaryForm& form, BinaryHead& head,
                           std::string& complaint) {
    head = {};
    HeadReader reader(in, form, head);
    const BinaryEnd end = reader.read();
    complaint = reader.complaint();
    return end;
}

std::optional<BinaryForm> binary_form_of(std::string_view bytes) {
    constexpr std::size_t magic_place = 8;
    if (bytes.size() > magic_place && bytes.substr(magic_place).starts_with("DUMP")) {
        std::int64_t size = 0;
        std::memcpy(&size, bytes.data(), sizeof size);
        BinaryForm form;
        form.magic = true;
        form.swapped = size < -20 || size >= 0;
        return form;
    }
    for (const BinaryForm::Box box :
         {BinaryForm::Box::flags, BinaryForm::Box::bare, BinaryForm::Box::bare_tilted})
        for (const bool swapped : {false, true})
            for (const bool narrow : {false, true}) {
                const BinaryForm form{false, swapped, narrow, box};
                if (makes_sense(bytes, form)) return form;
            }
    return std::nullopt;
}

namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, std::uint64_t byte, const std::string& what) {
    refuse_byte(file, static_cast<std::size_t>(byte), what);
}

// Skips the chunks of a frame. Returns false where the content ends within them.
bool pass_chunks(BinaryReader& in, const fs::path& file, const BinaryHead& head) {
    std::int64_t rows = 0;
    for (std::int32_t chunk = 0; chunk < head.chunks; ++chunk) {
        std::int32_t count = 0;
        const std::uint64_t place = in.place();
        if (!in.read(count)) return false;
        if (count < 0 || count % head.columns != 0)
            refuse(file, place,
                   fmt::format("a part of {} numbers in a frame of {} columns; the file is damaged", count,
                               head.columns));
        rows += count / head.columns;
        if (rows > head.rows)
            refuse(
                file, place,
                fmt::format(
                    "the frame of step {} has more rows than the {} that its head says; the file is damaged",
                    head.step, head.rows));
        if (!in.pass(static_cast<std::uint64_t>(count) * sizeof(double))) return false;
    }
    if (rows != head.rows)
        refuse(file, in.place(),
               fmt::format(
                   "the frame of step {} ends here after {} rows, and its head says {}; the file is damaged",
                   head.step, rows, head.rows));
    return true;
}

void check(const BinaryIndex& index, const BinaryHead& head, const fs::path& file) {
    if (index.frames.empty()) return;
    if (head.columns != index.columns || head.names != index.names)
        refuse(file, head.place,
               fmt::format(
                   "the columns change in the frame that begins here: {} ({}), and {} ({}) before; make a "
                   "file of each part",
                   head.columns, excerpt(fmt::format("{}", fmt::join(head.names, " "))), index.columns,
                   excerpt(fmt::format("{}", fmt::join(index.names, " ")))));
}

}  // namespace

void BinaryIndex::go_on(BinaryReader& in, const BinaryForm& form, const fs::path& file) {
    cut = false;
    in.seek(end);
    while (true) {
        BinaryHead head;
        std::string complaint;
        const BinaryEnd found = read_binary_head(in, form, head, complaint);
        if (found == BinaryEnd::nothing) return;
        if (found == BinaryEnd::damaged)
            refuse(file, in.place(), complaint + "; the file is damaged, or is no dump");
        cut_step = head.step;
        cut_rows = head.rows;
        if (found == BinaryEnd::whole) check(*this, head, file);
        cut = found == BinaryEnd::cut || !pass_chunks(in, file, head);
        if (cut) return;
        columns = head.columns;
        names = head.names;
        if (units.empty()) units = head.units;
        frames.push_back({head.place, head.step, head.rows, head.time});
        end = in.place();
    }
}

}  // namespace grainreel
