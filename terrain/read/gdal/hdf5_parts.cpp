#include "terrain/read/gdal/hdf5_parts.h"

#include <hdf5.h>

#include "engine/base/error.h"

namespace stereonav {
namespace {

// An object that HDF5 has open.
class Hdf5Id {
public:
    Hdf5Id(hid_t id, herr_t (*close)(hid_t)) : mId(id), mClose(close) {}
    ~Hdf5Id() {
        if (mId >= 0) mClose(mId);
    }
    Hdf5Id(const Hdf5Id&) = delete;
    Hdf5Id& operator=(const Hdf5Id&) = delete;
    operator hid_t() const { return mId; }

private:
    hid_t mId;
    herr_t (*mClose)(hid_t);
};

class QuietHdf5 {
public:
    QuietHdf5() {
        H5Eget_auto2(H5E_DEFAULT, &mPrint, &mData);
        H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
    }
    ~QuietHdf5() { H5Eset_auto2(H5E_DEFAULT, mPrint, mData); }
    QuietHdf5(const QuietHdf5&) = delete;
    QuietHdf5& operator=(const QuietHdf5&) = delete;

private:
    H5E_auto2_t mPrint = nullptr;
    void* mData = nullptr;
};

// netCDF's library ends by a signal where an object of a damaged file can not be opened: each is, before.
bool hasTypeAndSpace(hid_t object, hid_t (*type)(hid_t), hid_t (*space)(hid_t)) {
    return Hdf5Id(type(object), H5Tclose) >= 0 && Hdf5Id(space(object), H5Sclose) >= 0;
}

herr_t lookAtAttribute(hid_t place, const char* name, const H5A_info_t*, void*) {
    const Hdf5Id attribute(H5Aopen(place, name, H5P_DEFAULT), H5Aclose);
    return attribute >= 0 && hasTypeAndSpace(attribute, H5Aget_type, H5Aget_space) ? 0 : -1;
}

// 1 ends the visit: it leads elsewhere; less than 0: it is damaged.
herr_t lookAtObject(hid_t place, const char* name) {
    const Hdf5Id object(H5Oopen(place, name, H5P_DEFAULT), H5Oclose);
    if (object < 0) return -1;
    const H5I_type_t type = H5Iget_type(object);
    if (type == H5I_DATASET) {
        const Hdf5Id made(H5Dget_create_plist(object), H5Pclose);
        if (made < 0) return -1;
        if (H5Pget_external_count(made) > 0 || H5Pget_layout(made) == H5D_VIRTUAL) return 1;
        if (!hasTypeAndSpace(object, H5Dget_type, H5Dget_space)) return -1;
    }
    return H5Aiterate2(object, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, lookAtAttribute, nullptr);
}

herr_t lookAtLink(hid_t place, const char* name, const H5L_info_t* link, void* found) {
    if (link->type == H5L_TYPE_SOFT) return 0;
    const herr_t end = link->type == H5L_TYPE_HARD ? lookAtObject(place, name) : 1;
    if (end > 0) *static_cast<std::string*>(found) = name;
    return end;
}

}  // namespace

void checkHdf5Parts(const std::string& name) {
    const std::size_t from = name.starts_with('/') ? 0 : name.find('"') + 1;
    const std::string file = name.substr(from, name.find('"', from) - from);
    // Before anything of it is opened: else it speaks at the program's end of what a damaged file left open.
    [[maybe_unused]] static const herr_t atTheEnd = H5dont_atexit();
    const QuietHdf5 quiet;
    if (H5Fis_hdf5(file.c_str()) <= 0) return;
    const Hdf5Id open(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    std::string found;
    if (open < 0 || H5Lvisit(open, H5_INDEX_NAME, H5_ITER_NATIVE, lookAtLink, &found) < 0 ||
        H5Aiterate2(open, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, lookAtAttribute, nullptr) < 0)
        throw Error(file, "", "the file is cut off or damaged", "fetch or export the file again");
    if (!found.empty())
        throw Error(file, found, "leads to another file", "write all into one file, for example with nccopy");
}

}  // namespace stereonav
