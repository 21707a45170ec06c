// A mask as gzip-compressed NRRD: text header (teem.sourceforge.net/nrrd/format.html), then one gzip stream.
#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <fstream>
#include <memory>

#include "colon/study/study.h"
#include "engine/base/file.h"

namespace stereonav {
namespace {

constexpr int kLevel = 1;  // masks are long runs: more effort saves little
constexpr std::size_t kWriteBlock = 1 << 22;

std::string oneLine(std::string text) {
    for (char& c : text)
        if (static_cast<unsigned char>(c) < ' ' || c == '\\') c = ' ';
    return text;
}

std::string vectorText(const glm::dvec3& v) {
    return fmt::format("({:.17g},{:.17g},{:.17g})", v.x, v.y, v.z);
}

std::string headerOf(const VolumeFrame& frame, const std::string& comment, const HeaderFields& fields) {
    const auto step_mm = [&](int axis) { return vectorText(1e3 * frame.spacing[axis] * frame.axes[axis]); };
    std::string more;
    for (const auto& [name, value] : fields) more += oneLine(name) + ":=" + oneLine(value) + "\n";
    return fmt::format(
        "NRRD0005\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: {} {} {}\n"
        "space directions: {} {} {}\nkinds: domain domain domain\nencoding: gzip\n"
        "space units: \"mm\" \"mm\" \"mm\"\nspace origin: {}\ncomment:={}\n{}\n",
        frame.size.x, frame.size.y, frame.size.z, step_mm(0), step_mm(1), step_mm(2),
        vectorText(1e3 * frame.origin), oneLine(comment), more);
}

void writeGzip(std::ostream& out, const std::uint8_t* data, std::size_t bytes) {
    z_stream stream{};
    if (deflateInit2(&stream, kLevel, Z_DEFLATED, 16 + MAX_WBITS, 9, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::bad_alloc();
    const std::unique_ptr<z_stream, void (*)(z_stream*)> end(&stream, [](z_stream* s) { deflateEnd(s); });
    std::vector<unsigned char> output(1 << 18);
    do {
        const std::size_t block = std::min(bytes, kWriteBlock);
        stream.next_in = const_cast<Bytef*>(data);  // zlib only reads it
        stream.avail_in = static_cast<uInt>(block);
        data += block;
        bytes -= block;
        do {
            stream.next_out = output.data();
            stream.avail_out = static_cast<uInt>(output.size());
            deflate(&stream, bytes == 0 ? Z_FINISH : Z_NO_FLUSH);
            out.write(reinterpret_cast<const char*>(output.data()),
                      static_cast<std::streamsize>(output.size() - stream.avail_out));
        } while (stream.avail_out == 0);
    } while (bytes > 0);
}

}  // namespace

void writeMask(const std::filesystem::path& file, const MaskVolume& mask, const std::string& comment,
               const HeaderFields& fields) {
    writeFileAtomically(file, [&](const std::filesystem::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << headerOf(mask.frame, comment, fields);
        writeGzip(out, mask.values.data(), mask.frame.count());
        out.close();
        if (!out)
            throw Error(file.string(), "", "can not be written",
                        "check that the folder exists and has room and write permission");
    });
}

}  // namespace stereonav
