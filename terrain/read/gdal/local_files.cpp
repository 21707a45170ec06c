#include "terrain/read/gdal/local_files.h"

#include <cpl_conv.h>
#include <cpl_http.h>
#include <cpl_string.h>
#include <cpl_vsi_virtual.h>
#include <ogr_srs_api.h>
#include <sys/stat.h>

#include <cerrno>
#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "engine/base/error.h"

namespace stereonav {
namespace {

void refuseAddress(const char* name) {
    refuseToGdal(Error(name, "", "expected a file on this machine, found an address",
                       "fetch it first and name the copy")
                     .what());
}

// Takes the place of a file system that leads elsewhere: the network, standard input, other programs.
class NoFiles final : public VSIFilesystemHandler {
public:
    VSIVirtualHandle* Open(const char* name, const char*, bool, CSLConstList) override {
        refuseAddress(name);
        errno = EACCES;
        return nullptr;
    }
    int Stat(const char*, VSIStatBufL*, int) override {
        errno = ENOENT;
        return -1;
    }
};

// Pipes, sockets and devices: opening one may wait for ever, and reading one has no end.
bool isNeitherFileNorFolder(unsigned mode) {
    return !S_ISREG(mode) && !S_ISDIR(mode);
}

// The machine's files as they were read before, but for what is no file: that is not there.
class RegularFiles final : public VSIFilesystemHandler {
public:
    explicit RegularFiles(VSIFilesystemHandler* all) : mAll(all) {}

    VSIVirtualHandle* Open(const char* name, const char* access, bool setsError,
                           CSLConstList options) override {
        struct stat found {};
        if (access[0] == 'r' && stat(name, &found) == 0 && isNeitherFileNorFolder(found.st_mode)) {
            errno = ENOENT;
            return nullptr;
        }
        return mAll->Open(name, access, setsError, options);
    }
    int Stat(const char* name, VSIStatBufL* to, int flags) override {
        const int failed = mAll->Stat(name, to, flags);
        if (failed != 0 || !isNeitherFileNorFolder(to->st_mode)) return failed;
        errno = ENOENT;
        return -1;
    }
    int Unlink(const char* name) override { return mAll->Unlink(name); }
    int Mkdir(const char* name, long mode) override { return mAll->Mkdir(name, mode); }
    int Rmdir(const char* name) override { return mAll->Rmdir(name); }
    int Rename(const char* from, const char* to) override { return mAll->Rename(from, to); }
    char** ReadDirEx(const char* name, int most) override { return mAll->ReadDirEx(name, most); }
    VSIDIR* OpenDir(const char* name, int depth, const char* const* options) override {
        return mAll->OpenDir(name, depth, options);
    }
    int IsCaseSensitive(const char* name) override { return mAll->IsCaseSensitive(name); }
    GIntBig GetDiskFreeSpace(const char* name) override { return mAll->GetDiskFreeSpace(name); }
    int SupportsSparseFiles(const char* name) override { return mAll->SupportsSparseFiles(name); }

private:
    std::unique_ptr<VSIFilesystemHandler> mAll;
};

// Returns whether the prefix is one of those that readers here use: `.hgt.zip`, `.hgt.gz`, previews within
// JPEG files, what GDAL itself keeps in memory.
bool isLocalPrefix(std::string_view prefix) {
    for (const std::string_view local : {"/vsimem/", "/vsizip/", "/vsigzip/", "/vsisubfile/"})
        if (prefix == local) return true;
    return false;
}

void replaceFileSystems() {
    // GDAL has no way to hand them back, and some are one under two names.
    static auto* const replaced = new std::vector<VSIFilesystemHandler*>;
    char** const prefixes = VSIGetFileSystemsPrefixes();
    for (char** prefix = prefixes; prefix && *prefix; ++prefix) {
        if (**prefix == '\0' || isLocalPrefix(*prefix)) continue;
        replaced->push_back(VSIFileManager::GetHandler(*prefix));
        VSIFileManager::InstallHandler(*prefix, new NoFiles);
    }
    CSLDestroy(prefixes);
    VSIFileManager::InstallHandler("", new RegularFiles(VSIFileManager::GetHandler("")));
}

CPLHTTPResult* refuseRequest(const char* address, CSLConstList options, GDALProgressFunc, void*,
                             CPLHTTPFetchWriteFunc, void*, void*) {
    if (!CSLFetchNameValue(options, "CLOSE_PERSISTENT")) refuseAddress(address);
    auto* const result = static_cast<CPLHTTPResult*>(CPLCalloc(1, sizeof(CPLHTTPResult)));
    result->nStatus = 1;
    result->pszErrBuf = CPLStrdup("no address is asked");
    return result;
}

}  // namespace

void refuseToGdal(const std::string& line) {
    CPLError(CE_Failure, kRefused, "%s", line.c_str());
}

void keepGdalToLocalFiles() {
    replaceFileSystems();
    CPLHTTPSetFetchCallback(refuseRequest, nullptr);
    OSRSetPROJEnableNetwork(FALSE);  // else grids of datums are fetched where PROJ_NETWORK says so
    constexpr std::pair<const char*, const char*> kOptions[] = {
        {"CPL_VSIL_CURL_ALLOWED_EXTENSIONS", "none"},  // should a handler come back
        {"GDAL_VRT_ENABLE_PYTHON", "NO"},
        {"OGR_SQLITE_ALLOW_EXTERNAL_ACCESS", "NO"},
        // Else a view in a GeoPackage calls all functions there are: some read XML by its address.
        {"OGR_SQLITE_PRAGMA", "trusted_schema=OFF"},
        {"ALLOW_OGR_SQL_FUNCTIONS_FROM_TRIGGER_AND_VIEW", "NO"},
        {"SPATIALITE_LOAD",
         "NO"},  // else a virtual table in a GeoPackage reads any file: text, sheets, shapes
    };
    for (const auto& [name, value] : kOptions) CPLSetConfigOption(name, value);
}

}  // namespace stereonav
