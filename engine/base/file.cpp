#include "engine/base/file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <utility>

#include "engine/base/error.h"
#include "engine/base/files_read.h"
#include "engine/base/memory.h"
#include "engine/base/own_folder.h"
#include "engine/base/regular_file.h"

namespace stereonav {
namespace fs = std::filesystem;
namespace {

constexpr int kMostLinks = 40;  // the limit of Linux: more go round in circles
constexpr std::size_t kBlock = 1 << 20;
constexpr std::size_t kLongestStem = 200;  // bytes, so that a temporary's name is not too long
constexpr const char* kCheckPlace = "check that the folder exists and has room and write permission";

Error unwritable(const fs::path& path, int reason) {
    return {path.string(), "",
            reason ? std::string("can not be written: ") + std::strerror(reason) : "can not be written",
            kCheckPlace};
}

// Returns whether bytes are written into the file itself, since no file can take its place.
bool isStream(const fs::path& path) {
    std::error_code code;
    const fs::file_type type = fs::status(path, code).type();
    return type == fs::file_type::fifo || type == fs::file_type::character || type == fs::file_type::block ||
           type == fs::file_type::socket;
}

// Returns the end of a chain of links, which need not be there.
fs::path endOfLinks(const fs::path& path) {
    std::error_code code;
    fs::path at = path;
    for (int n = 0; n < kMostLinks; ++n) {
        if (fs::symlink_status(at, code).type() != fs::file_type::symlink) return at;
        const fs::path to = fs::read_symlink(at, code);
        if (code) break;
        at = to.is_absolute() ? to : at.parent_path() / to;
    }
    throw Error(path.string(), "", "is a link that leads nowhere", "take it away, or name another file");
}

fs::path folderOf(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

// Makes an empty file beside it, which nobody else may read. Its name can not be foreseen, and is not one
// that was there: what others put in its way is neither followed nor emptied. "" where that does not go:
// errno.
fs::path madeBesides(const fs::path& file) {
    const std::string end = ".part" + file.extension().string();
    fs::path temporary = file;
    temporary.replace_filename("." + file.stem().string().substr(0, kLongestStem) + "." +
                               std::to_string(getpid()) + ".XXXXXX" + end);
    std::string name = temporary.string();
    const int made = mkostemps(name.data(), static_cast<int>(end.size()), O_CLOEXEC);
    if (made < 0) return {};
    close(made);
    return name;
}

// Permissions of new files. The system tells the umask only by changing it, which other threads would feel.
mode_t usualMode() {
    constexpr mode_t kAll = 0666, kPrivate = 0600;
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with("Umask:")) return kAll & ~std::strtoul(line.c_str() + 6, nullptr, 8);
    return kPrivate;
}

Error unreadable(const fs::path& path, int reason) {
    return {path.string(), "", std::string("can not be read: ") + std::strerror(reason),
            "check the name and its permissions, and the disk it is on"};
}

// Closed once, so that what the system says at the end is heard.
class OpenFile {
public:
    // place: what errors name.
    OpenFile(fs::path place, const fs::path& path, int flags)
        : mPlace(std::move(place)), mFile(open(path.c_str(), flags | O_CLOEXEC, 0666)) {
        if (mFile < 0) throw unwritable(mPlace, errno);
    }
    ~OpenFile() {
        if (mFile >= 0) close(mFile);
    }
    OpenFile(const OpenFile&) = delete;
    OpenFile& operator=(const OpenFile&) = delete;

    void write(const char* data, std::size_t bytes) const {
        while (bytes > 0) {
            const ssize_t written = ::write(mFile, data, bytes);
            if (written < 0 && errno == EINTR) continue;
            if (written < 0) throw unwritable(mPlace, errno);
            data += written;
            bytes -= static_cast<std::size_t>(written);
        }
    }
    // Bytes that were read, fewer than asked for at the end alone.
    std::size_t read(char* data, std::size_t bytes) const {
        std::size_t all = 0;
        while (all < bytes) {
            const ssize_t got = ::read(mFile, data + all, bytes - all);
            if (got < 0 && errno == EINTR) continue;
            if (got < 0) throw unreadable(mPlace, errno);
            if (got == 0) break;
            all += static_cast<std::size_t>(got);
        }
        return all;
    }
    // Some systems have no permissions.
    void allow(mode_t mode) const {
        if (fchmod(mFile, mode) != 0 && errno != EPERM && errno != ENOTSUP) throw unwritable(mPlace, errno);
    }
    // Until all of it is on the disk: some systems take bytes first and find room for them later.
    void flush() const {
        if (fsync(mFile) != 0 && errno != EINVAL && errno != EROFS) throw unwritable(mPlace, errno);
    }
    void finish() {
        const int file = std::exchange(mFile, -1);
        if (close(file) != 0 && errno != EINTR) throw unwritable(mPlace, errno);
    }

private:
    fs::path mPlace;
    int mFile;
};

// Makes the new name stay, too. The content is safe already, so an error is none.
void flushFolder(const fs::path& folder) {
    const int file = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (file < 0) return;
    fsync(file);
    close(file);
}

// Calls put(write), with write(data, bytes) to a stream or to standard output.
template <typename Put>
void intoStream(const fs::path& place, const Put& put) {
    if (isStandardOutput(place)) {
        put([](const char* data, std::size_t bytes) {
            if (std::fwrite(data, 1, bytes, stdout) != bytes || std::fflush(stdout) != 0)
                throw unwritable("standard output", errno);
        });
        return;
    }
    OpenFile out(place, place, O_WRONLY);
    put([&](const char* data, std::size_t bytes) { out.write(data, bytes); });
    out.finish();
}

bool isInCache(const fs::path& file) {
    return folderOf(file) == cachePlace();
}

// Throws Error unless a file can be made, or what is there be replaced.
void checkFolder(const fs::path& path, const fs::path& target) {
    std::error_code code;
    const fs::path folder = folderOf(target);
    if (isInCache(target)) makeOwnFolder(folder, kMoveCache);
    if (!fs::exists(folder, code))
        throw Error(path.string(), "", "can not be written: there is no folder \"" + folder.string() + "\"",
                    "make it, or name another place");
    if (!fs::is_directory(folder, code))
        throw Error(path.string(), "", "can not be written: \"" + folder.string() + "\" is no folder",
                    "name another place");
    if (fs::is_symlink(target, code)) return;  // which is replaced
    if (fs::is_directory(target, code))
        throw Error(path.string(), "", "can not be written: it is a folder", "name a file");
    if (fs::exists(target, code) && access(target.c_str(), W_OK) != 0) throw unwritable(path, errno);
}

}  // namespace

bool isHiddenFile(const fs::path& path) {
    return path.filename().native().starts_with('.');
}

std::string kindOfFile(const fs::path& path) {
    std::error_code code;
    switch (fs::status(path, code).type()) {
        case fs::file_type::directory:
            return "a folder";
        case fs::file_type::fifo:
            return "a pipe";
        case fs::file_type::character:
        case fs::file_type::block:
            return "a device";
        case fs::file_type::socket:
            return "a socket";
        default:
            return "something else";
    }
}

void checkFileToRead(const fs::path& path) {
    std::error_code code;
    const fs::file_status is = fs::status(path, code);
    if (!fs::exists(is) || fs::is_regular_file(is)) return;
    throw Error(path.string(), "", "expected a file, found " + kindOfFile(path),
                fs::is_directory(is) ? "name the file itself" : "copy what comes out of it into a file");
}

std::string readTextFile(const fs::path& path) {
    RegularFile in(path);
    checkMemory(path.string(), static_cast<double>(in.size()), "name a smaller file");
    std::string content(in.size(), '\0');
    content.resize(in.read(content.data(), content.size()));
    for (std::string more(kBlock, '\0');;) {  // it grew, or is one that does not tell its size
        const std::size_t bytes = in.read(more.data(), more.size());
        if (bytes == 0) return content;
        content.append(more, 0, bytes);
    }
}

bool isStandardOutput(const fs::path& path) {
    for (const char* name : {"-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"})
        if (path == name) return true;
    return false;
}

void checkPlaceForFile(const fs::path& path) {
    if (isStandardOutput(path)) return;
    if (isStream(path)) {
        if (access(path.c_str(), W_OK) != 0) throw unwritable(path, errno);
        return;
    }
    const fs::path target = isInCache(path) ? path : endOfLinks(path);
    checkFolder(path, target);
    const fs::path probe = madeBesides(target);
    if (probe.empty())
        throw Error(path.string(), "",
                    "can not be written: \"" + folderOf(target).string() + "\" takes no new file",
                    kCheckPlace);
    std::error_code code;
    fs::remove(probe, code);
}

PendingFile::PendingFile(const fs::path& place, Over over, Readers readers)
    : mPlace(place), mOver(over), mReaders(readers) {
    if (isInCache(place)) mOver = Over::Anything, mReaders = Readers::UserAlone;
    if (mReaders == Readers::UserAlone || (!isStandardOutput(place) && !isStream(place))) {
        mTarget = mReaders == Readers::UserAlone ? place : endOfLinks(place);
        checkFolder(place, mTarget);
        checkNotRead();
        mTemporary = madeBesides(mTarget);
        if (mTemporary.empty()) throw unwritable(place, errno);
        mUnfinished.emplace(mTemporary.c_str());
        return;
    }
    std::error_code code;
    std::string folder = (fs::temp_directory_path(code) / "stereonav-XXXXXX").string();
    if (!mkdtemp(folder.data())) throw unwritable(folder, errno);
    mOwnFolder = folder;
    mUnfinishedFolder.emplace(mOwnFolder.c_str());
    mTemporary = madeBesides(mOwnFolder / ("part" + place.extension().string()));
    if (mTemporary.empty()) {
        const int reason = errno;
        fs::remove_all(mOwnFolder, code);
        throw unwritable(place, reason);
    }
    mUnfinished.emplace(mTemporary.c_str());
}

PendingFile::~PendingFile() {
    std::error_code code;
    fs::remove(mTemporary, code);
    if (!mOwnFolder.empty()) fs::remove_all(mOwnFolder, code);
}

void PendingFile::checkNotRead() const {
    if (mOver == Over::NothingRead) checkIsNoInput(mPlace);
}

void PendingFile::finish(Flush flush) {
    if (!mOwnFolder.empty()) return intoPlace();
    checkNotRead();
    std::error_code code;
    {
        OpenFile written(mPlace, mTemporary, O_RDWR | O_NOFOLLOW);
        written.allow(modeInPlace());
        if (flush == Flush::ToDisk) written.flush();
        written.finish();
    }
    fs::rename(mTemporary, mTarget, code);
    if (code) throw unwritable(mPlace, code.value());
    forgetFileRead(mTarget);
    if (flush == Flush::ToDisk) flushFolder(folderOf(mTarget));
}

unsigned PendingFile::modeInPlace() const {
    if (mReaders == Readers::UserAlone) return S_IRUSR | S_IWUSR;
    struct stat was {};
    return stat(mTarget.c_str(), &was) == 0 && S_ISREG(was.st_mode) ? was.st_mode & 0777 : usualMode();
}

void PendingFile::intoPlace() {
    const OpenFile in(mPlace, mTemporary, O_RDONLY);
    intoStream(mPlace, [&](const auto& write) {
        std::string block(kBlock, '\0');
        while (const std::size_t bytes = in.read(block.data(), block.size())) write(block.data(), bytes);
    });
}

void checkIsNoInput(const fs::path& place) {
    if (!isStandardOutput(place) && !isStream(place) && wasFileRead(place))
        throw Error(place.string(), "", "is read in this run, and would be lost", "name another file");
}

void writeFileAtomically(const fs::path& path, const std::function<void(const fs::path&)>& write, Over over) {
    PendingFile file(path, over);
    try {
        write(file.temporary());
    } catch (const fs::filesystem_error& error) {
        throw unwritable(path, error.code().value());
    }
    std::error_code code;
    if (fs::file_size(file.temporary(), code) == 0 && !code) throw unwritable(path, 0);
    file.finish();
}

void writeTextFile(const fs::path& path, const std::string& content, Flush flush, Over over) {
    if (isStandardOutput(path) || isStream(path))
        return intoStream(path, [&](const auto& write) { write(content.data(), content.size()); });
    PendingFile file(path, over);
    OpenFile out(path, file.temporary(), O_WRONLY | O_NOFOLLOW);
    out.write(content.data(), content.size());
    out.finish();
    file.finish(flush);
}

}  // namespace stereonav
