// A struct of settings with each of its members changed in turn, so that a test can check that each of them
// counts: in the key of a cache, or where settings are compared. When a struct gets another member, this does
// not compile until that member is named (Members), and then it is changed as well.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

namespace stereonav::test {

// Specialised for each struct: `names` of all its members, in their order.
template <typename T>
struct Members {};

template <typename T>
concept HasMembers = requires {
    Members<T>::names.size();
};

// Returns references to all members. A binding with fewer or more names than the struct has members is an
// error of the compiler.
template <std::size_t count, typename T>
constexpr auto membersOf(T& s) {
    if constexpr (count == 1) {
        auto& [a] = s;
        return std::tie(a);
    } else if constexpr (count == 2) {
        auto& [a, b] = s;
        return std::tie(a, b);
    } else if constexpr (count == 3) {
        auto& [a, b, c] = s;
        return std::tie(a, b, c);
    } else if constexpr (count == 4) {
        auto& [a, b, c, d] = s;
        return std::tie(a, b, c, d);
    } else if constexpr (count == 5) {
        auto& [a, b, c, d, e] = s;
        return std::tie(a, b, c, d, e);
    } else if constexpr (count == 6) {
        auto& [a, b, c, d, e, f] = s;
        return std::tie(a, b, c, d, e, f);
    } else if constexpr (count == 7) {
        auto& [a, b, c, d, e, f, g] = s;
        return std::tie(a, b, c, d, e, f, g);
    } else if constexpr (count == 8) {
        auto& [a, b, c, d, e, f, g, h] = s;
        return std::tie(a, b, c, d, e, f, g, h);
    } else if constexpr (count == 9) {
        auto& [a, b, c, d, e, f, g, h, i] = s;
        return std::tie(a, b, c, d, e, f, g, h, i);
    } else if constexpr (count == 10) {
        auto& [a, b, c, d, e, f, g, h, i, j] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j);
    } else if constexpr (count == 12) {
        auto& [a, b, c, d, e, f, g, h, i, j, k, l] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l);
    } else if constexpr (count == 13) {
        auto& [a, b, c, d, e, f, g, h, i, j, k, l, m] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m);
    } else if constexpr (count == 14) {
        auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n);
    } else if constexpr (count == 15) {
        auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o);
    } else if constexpr (count == 23) {
        auto& [a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x] = s;
        return std::tie(a, b, c, d, e, f, g, h, i, j, k, l, m, n, o, p, q, r, t, u, v, w, x);
    } else {
        static_assert(count == 0, "add a binding of so many names");
    }
}

template <typename T>
struct Changed {
    std::string what;  // "light.lights[0].radius"
    T value;
};

// Makes the changes. Names in `leftOut` are those of members that are not changed: ones that do not count,
// and pointers and functions, which a test changes itself where they count.
class MemberChanger {
public:
    explicit MemberChanger(std::vector<std::string> leftOut) : mLeftOut(std::move(leftOut)) {}

    template <typename T>
    using Take = std::function<void(const std::string& what, const T& changed)>;

    // Calls take() with values that differ from this one in one member.
    template <typename T>
    void change(const T& value, const std::string& name, const Take<T>& take) {
        if (isLeftOut(name)) return;
        if constexpr (HasMembers<T>)
            changeMembers<T>(value, name, take, std::make_index_sequence<Members<T>::names.size()>());
        else if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>)
            changeNumber<T>(value, name, take);
        else if constexpr (requires { value.has_value(); })
            changeOptional<T>(value, name, take);
        else if constexpr (std::same_as<T, std::string>)
            take(name, value + "x");
        else if constexpr (std::same_as<T, std::filesystem::path>)
            take(name, value / "x");
        else if constexpr (requires(T & all) { all.emplace_back(); })
            changeList<T>(value, name, take);
        else if constexpr (requires { T::length(); })  // vectors and matrices of GLM
            for (int n = 0; n < static_cast<int>(T::length()); ++n)
                changePart<T>(
                    value, place(name, n), [n](T & all) -> auto& { return all[n]; }, take);
        else if constexpr (requires { std::tuple_size<T>::value; })  // std::array
            for (std::size_t n = 0; n < value.size(); ++n)
                changePart<T>(
                    value, place(name, n), [n](T & all) -> auto& { return all[n]; }, take);
        else
            ADD_FAILURE() << name
                          << " is of a type that is not known here: leave it out, or change it by hand";
    }

    // Returns the names that were left out and that no member has.
    const std::set<std::string>& unknown() const { return mUnknown; }

private:
    template <typename Number>
    static std::string place(const std::string& name, Number n) {
        return name + "[" + std::to_string(n) + "]";
    }

    bool isLeftOut(const std::string& name) {
        if (std::find(mLeftOut.begin(), mLeftOut.end(), name) == mLeftOut.end()) return false;
        mUnknown.erase(name);
        return true;
    }

    // Makes the changes of a part, put back into the whole. part(whole): a reference to the part.
    template <typename T, typename Part>
    void changePart(const T& whole, const std::string& name, const Part& part, const Take<T>& take) {
        T copy = whole;
        using P = std::remove_reference_t<decltype(part(copy))>;
        change<P>(part(copy), name, [&](const std::string& what, const P& other) {
            T changed = whole;
            part(changed) = other;
            take(what, changed);
        });
    }

    template <typename T, std::size_t... n>
    void changeMembers(const T& value, const std::string& name, const Take<T>& take,
                       std::index_sequence<n...>) {
        const std::string before = name.empty() ? "" : name + ".";
        (changePart<T>(
             value, before + Members<T>::names[n],
             [](T & all) -> auto& { return std::get<n>(membersOf<sizeof...(n)>(all)); }, take),
         ...);
    }

    // Changes a number by as little as possible, and by a lot.
    template <typename T>
    static void changeNumber(T value, const std::string& name, const Take<T>& take) {
        if constexpr (std::same_as<T, bool>) {
            take(name, !value);
        } else if constexpr (std::is_enum_v<T>) {
            const auto whole = static_cast<std::underlying_type_t<T>>(value);
            take(name, static_cast<T>(whole == 0 ? 1 : whole - 1));
        } else if constexpr (std::floating_point<T>) {
            take(name + " by a little", std::nextafter(value, value > 0 ? T(0) : T(1)));
            take(name, std::isfinite(value) ? value + 1 : T(1));
        } else {
            take(name, static_cast<T>(value + 1));
            if constexpr (sizeof(T) == 8) take(name + " beyond 32 bits", value ^ (T(1) << 40));
        }
    }

    template <typename T>
    void changeOptional(const T& value, const std::string& name, const Take<T>& take) {
        using Inner = typename T::value_type;
        if (!value) return take(name + " given", Inner());
        take(name + " not given", std::nullopt);
        change<Inner>(*value, name, [&](const std::string& what, const Inner& other) { take(what, other); });
    }

    template <typename T>
    void changeList(const T& value, const std::string& name, const Take<T>& take) {
        T longer = value;
        longer.emplace_back();
        take(name + " longer", longer);
        if (value.empty()) return;
        T shorter = value;
        shorter.pop_back();
        take(name + " shorter", shorter);
        for (std::size_t n = 0; n < value.size(); ++n)
            changePart<T>(
                value, place(name, n), [n](T & all) -> auto& { return all[n]; }, take);
        if (value.size() < 2) return;
        T turned = value;
        std::reverse(turned.begin(), turned.end());
        take(name + " in another order", turned);
    }

    const std::vector<std::string> mLeftOut;
    std::set<std::string> mUnknown{mLeftOut.begin(), mLeftOut.end()};
};

// Returns the struct with each of its members, and of theirs, changed in turn, except those that are left
// out.
template <typename T>
std::vector<Changed<T>> eachMemberChanged(const T& base, const std::vector<std::string>& leftOut = {}) {
    MemberChanger changer(leftOut);
    std::vector<Changed<T>> all;
    changer.change<T>(base, "", [&](const std::string& what, const T& changed) {
        all.push_back({what, changed});
    });
    EXPECT_TRUE(changer.unknown().empty()) << "there is no " << *changer.unknown().begin();
    EXPECT_FALSE(all.empty());
    return all;
}

// Expects that any two of the base and the changed ones have different keys, and equal settings equal ones.
template <typename T, typename Key>
void expectKeysDiffer(const T& base, const std::vector<Changed<T>>& changes, const Key& key) {
    std::map<std::decay_t<decltype(key(base))>, std::string> known{{key(base), "the base"}};
    EXPECT_TRUE(known.contains(key(T(base)))) << "equal settings have different keys";
    for (const Changed<T>& changed : changes) {
        const auto [other, fresh] = known.emplace(key(changed.value), changed.what);
        EXPECT_TRUE(fresh) << changed.what << " has the key of " << other->second;
    }
}

// Expects that members without influence on the result leave the key of the base, so that a kept result is
// found again.
template <typename T, typename Key>
void expectKeysEqual(const T& base, const std::vector<Changed<T>>& changes, const Key& key) {
    for (const Changed<T>& changed : changes) EXPECT_EQ(key(changed.value), key(base)) << changed.what;
}

// Expects that operator== of a struct compares each member.
template <typename T>
void expectEachMemberCompared(const T& base, const std::vector<std::string>& leftOut = {}) {
    EXPECT_TRUE(base == T(base));
    for (const Changed<T>& changed : eachMemberChanged(base, leftOut)) {
        EXPECT_FALSE(base == changed.value) << changed.what;
        EXPECT_TRUE(changed.value == changed.value) << changed.what;
    }
}

}  // namespace stereonav::test
