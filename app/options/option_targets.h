// The structures that the values of one command are stored in.
#pragma once

#include <stdexcept>
#include <string>
#include <typeinfo>

#include "app/options/scene_options.h"
#include "engine/image/stereo_compose.h"

namespace stereonav {

class OptionTargets {
public:
    // Structures that shared rows of the table write to; null: the command has none.
    SceneOptions* scene = nullptr;
    SizeOption* size = nullptr;
    Telling* telling = nullptr;
    RayOptions* rays = nullptr;
    OutputMode* mode = nullptr;
    std::string *method = nullptr, *path = nullptr;
    bool* curvature = nullptr;
    std::optional<double>* refraction = nullptr;

    // Sets the command's structure; shared rows write to its members of these names. It must outlive this
    // object.
    template <typename Options>
    void bind(Options& options) {
        mType = &typeid(Options);
        mOptions = &options;
        if constexpr (requires { options.scene; }) {
            scene = &options.scene;
            curvature = &options.scene.curvature;
            refraction = &options.scene.refraction;
        }
        if constexpr (requires { options.curvature; }) curvature = &options.curvature;
        if constexpr (requires { options.refraction; }) refraction = &options.refraction;
        if constexpr (requires { options.size; }) size = &options.size;
        if constexpr (requires { options.telling; }) telling = &options.telling;
        if constexpr (requires { options.rays; }) rays = &options.rays;
        if constexpr (requires { mode = &options.mode; }) mode = &options.mode;  // not that of view, optional
        if constexpr (requires { options.method; }) method = &options.method;
        if constexpr (requires { options.path; }) path = &options.path;
    }

    // Returns the command's structure; throws where it is of another type than the row of the table expects.
    template <typename Options>
    Options& of() const {
        if (!mType || *mType != typeid(Options))
            throw std::logic_error("an option is for a command without its structure");
        return *static_cast<Options*>(mOptions);
    }

private:
    const std::type_info* mType = nullptr;
    void* mOptions = nullptr;
};

}  // namespace stereonav
