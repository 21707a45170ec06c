#include "engine/gltf/gltf_size.h"

#include <fmt/format.h>
#include <tiny_gltf.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "engine/base/error.h"
#include "engine/base/memory.h"
#include "engine/text/json_check.h"

namespace stereonav {
namespace {

constexpr const char* kSizeAdvice = "split the model, or export it with fewer parts";

// Bytes of values, in the tree of JSON and in the model together.
constexpr double kNumberBytes = 48;
constexpr double kKeyBytes = 96;
constexpr double kTextCopies = 5;  // a buffer within the text, while it is unpacked
constexpr double kPartBytes = 2.0 * std::max({sizeof(tinygltf::Primitive), sizeof(tinygltf::AnimationChannel),
                                              sizeof(tinygltf::AnimationSampler)});
// Bytes of a number in extras, extensions and materials, where each is a value with a name.
constexpr double kNamedBytes = 96 + 2.0 * sizeof(tinygltf::Value);

// Bytes of an entry of one of the lists that a description consists of. They double: a list is held twice
// while it grows.
double entryBytes(const std::string& list) {
    static constexpr std::pair<const char*, std::size_t> kEntries[] = {
        {"accessors", sizeof(tinygltf::Accessor)}, {"animations", sizeof(tinygltf::Animation)},
        {"buffers", sizeof(tinygltf::Buffer)},     {"bufferViews", sizeof(tinygltf::BufferView)},
        {"cameras", sizeof(tinygltf::Camera)},     {"images", sizeof(tinygltf::Image)},
        {"materials", sizeof(tinygltf::Material)}, {"meshes", sizeof(tinygltf::Mesh)},
        {"nodes", sizeof(tinygltf::Node)},         {"samplers", sizeof(tinygltf::Sampler)},
        {"scenes", sizeof(tinygltf::Scene)},       {"skins", sizeof(tinygltf::Skin)},
        {"textures", sizeof(tinygltf::Texture)}};
    for (const auto& [name, bytes] : kEntries)
        if (list == name) return 2.0 * static_cast<double>(bytes) + kPartBytes / 4;
    return kPartBytes;
}

// Walks over the description without keeping any of it.
class Counter final : public nlohmann::json_sax<nlohmann::json> {
public:
    explicit Counter(std::size_t binary) : mBinary(static_cast<double>(binary)) {}

    double bytes() const { return mBytes; }
    std::size_t objects() const { return mObjects; }
    std::size_t materials() const { return mMaterials; }

    bool null() override { return number(); }
    bool boolean(bool) override { return number(); }
    bool number_integer(std::int64_t) override { return number(); }
    bool number_unsigned(std::uint64_t) override { return number(); }
    bool number_float(double, const std::string&) override { return number(); }
    bool string(std::string& text) override {
        const bool names = isEntryOf("buffers") && mKey == "uri" && !text.empty();
        mBytes += kTextCopies * static_cast<double>(text.size());
        number();
        mHasFile |= names;
        return true;
    }
    bool binary(binary_t&) override { return number(); }
    bool key(std::string& name) override {
        mKey = name;
        mBytes += kKeyBytes + static_cast<double>(name.size());
        return true;
    }
    bool start_object(std::size_t) override {
        ++mObjects;
        open();
        if (isEntryOf("materials")) ++mMaterials;
        if (isEntryOf("buffers")) mHasFile = false;
        return mObjects <= kMostGltfObjects && mMaterials <= kMostGltfMaterials;
    }
    bool end_object() override {
        if (isEntryOf("buffers") && !mHasFile) mBytes += mBinary;
        mLevels.pop_back();
        mKey.clear();
        return true;
    }
    bool start_array(std::size_t) override {
        open();
        return true;
    }
    bool end_array() override {
        mLevels.pop_back();
        mKey.clear();
        return true;
    }
    // Left to tinygltf, which says what is wrong.
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override {
        return false;
    }

private:
    // Bytes that each value in a list or object takes, by its kind.
    struct Level {
        double part = kPartBytes, number = kNumberBytes;
    };

    bool number() {
        mBytes += mLevels.empty() ? 0 : mLevels.back().number;
        takeKey();
        return true;
    }
    // The name of the value that begins. Of several of one name the last one counts.
    std::string takeKey() {
        if (isEntryOf("buffers") && mKey == "uri") mHasFile = false;
        return std::exchange(mKey, "");
    }
    void open() {
        const std::string name = takeKey();
        Level inside = mLevels.empty() ? Level() : mLevels.back();
        mBytes += inside.part;
        if (mLevels.size() >= 2) inside.part = std::min(inside.part, kPartBytes);
        if (mLevels.size() == 1) {
            mList = name;
            inside.part = entryBytes(name);
            if (name == "materials") inside.number = kNamedBytes;
        }
        if (name == "extras" || name == "extensions") inside = {kPartBytes + kNamedBytes, kNamedBytes};
        mLevels.push_back(inside);
    }
    // Returns whether an entry of that list is being read, and nothing within it.
    bool isEntryOf(const char* list) const { return mLevels.size() == 3 && mList == list; }

    const double mBinary;
    double mBytes = 0;
    std::size_t mObjects = 0, mMaterials = 0;
    std::vector<Level> mLevels;
    std::string mKey, mList;  // the list at the top that is being read
    bool mHasFile = false;    // the buffer that is being read
};

}  // namespace

void checkGltfSize(std::string_view json, std::size_t binary, const std::string& file) {
    checkJson(json, file, kSizeAdvice);
    Counter counter(binary);
    nlohmann::json::sax_parse(json, &counter);
    if (counter.objects() > kMostGltfObjects)
        throw Error(file, "", fmt::format("describes more than {} objects", kMostGltfObjects), kSizeAdvice);
    if (counter.materials() > kMostGltfMaterials)
        throw Error(file, "", fmt::format("has more than {} materials", kMostGltfMaterials), kSizeAdvice);
    checkMemory(file, counter.bytes(), kSizeAdvice);
}

}  // namespace stereonav
