// SPDX-FileCopyrightText: 2026 The ism authors
// SPDX-License-Identifier: MIT
#include "values.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "arrays.hpp"
#include <pybind11/numpy.h>

#include "ism/dataset/coco_fields.hpp"

namespace ism_python {

namespace {

/// Whether an array that stands as a segmentation is a mask. Polygons are floats, or have few rows.
bool is_mask(const py::handle& object) {
    if (!py::isinstance<py::array>(object)) return false;
    const auto array = py::reinterpret_borrow<py::array>(object);
    constexpr py::ssize_t least_rows = 16;  // of a picture
    return array.ndim() == 2 && (array.dtype().kind() == 'b' || array.shape(0) >= least_rows);
}

/// Makes JSON of one object, and knows the way to the value that it is at.
class ToJson {
public:
    explicit ToJson(std::string place) : place_(std::move(place)) {}

    [[nodiscard]] Json object(const py::handle& mapping) {
        if (++depth_ > 64) refuse("at most 64 levels", "more");
        Json json = Json::object();
        for (const auto& [key, value] : dict_of(mapping)) {
            if (!py::isinstance<py::str>(key)) refuse("keys that are strings", py::repr(key));
            const std::string name = text(key);
            const std::size_t end = way_.size();
            way_ += (way_.empty() ? "" : ".") + name;
            json[name] = name == "segmentation" && is_mask(value) ? mask(value) : any(value);
            way_.resize(end);
        }
        --depth_;
        return json;
    }

private:
    [[noreturn]] void refuse(std::string_view expected, const std::string& got) const {
        throw ism::Error(ism::one_line(ism::join_text(at(), ": expected ", expected, ", got ", got)));
    }

    [[nodiscard]] std::string at() const { return way_.empty() ? place_ : place_ + ", " + way_; }

    [[nodiscard]] py::dict dict_of(const py::handle& mapping) const {
        try {
            return py::dict(py::reinterpret_borrow<py::object>(mapping));
        } catch (const py::error_already_set&) {
            refuse("a dict", type_text(mapping));
        }
    }

    [[nodiscard]] Json any(const py::handle& value) {
        PyObject* const it = value.ptr();
        if (value.is_none()) return nullptr;
        if (PyBool_Check(it) != 0) return it == Py_True;
        if (PyLong_Check(it) != 0) return whole(value);
        if (PyFloat_Check(it) != 0) return real(PyFloat_AS_DOUBLE(it));
        if (PyUnicode_Check(it) != 0) return text(value);
        if (PyBytes_Check(it) != 0) return ascii(value);
        if (PyList_Check(it) != 0 || PyTuple_Check(it) != 0) return array(value);
        if (py::hasattr(value, "keys")) return object(value);
        if (py::hasattr(value, "tolist")) return any(value.attr("tolist")());
        refuse("what JSON can hold", type_text(value));
    }

    [[nodiscard]] Json array(const py::handle& list) {
        if (++depth_ > 64) refuse("at most 64 levels", "more");
        Json json = Json::array();
        const std::size_t end = way_.size();
        for (const py::handle& value : list) {
            way_ += ism::join_text('[', json.size(), ']');
            json.push_back(any(value));
            way_.resize(end);
        }
        --depth_;
        return json;
    }

    [[nodiscard]] Json whole(const py::handle& number) const {
        int overflow = 0;
        const long long value = PyLong_AsLongLongAndOverflow(number.ptr(), &overflow);
        if (overflow != 0) refuse("a whole number of 64 bits", "a larger one");
        return value;
    }

    [[nodiscard]] Json real(double number) const {
        if (!std::isfinite(number)) refuse("a number", ism::join_text(number));
        return number;
    }

    [[nodiscard]] std::string text(const py::handle& string) const {
        Py_ssize_t size = 0;
        const char* const first = PyUnicode_AsUTF8AndSize(string.ptr(), &size);
        if (first != nullptr) return {first, std::size_t(size)};
        PyErr_Clear();
        refuse("text in Unicode", "surrogates");
    }

    [[nodiscard]] Json ascii(const py::handle& bytes) const {
        std::string held = py::reinterpret_borrow<py::bytes>(bytes);
        if (std::any_of(held.begin(), held.end(), [](unsigned char one) { return one > 127; }))
            refuse("bytes of ASCII", "others");
        return held;
    }

    [[nodiscard]] Json mask(const py::handle& value) const {
        return ism::detail::rle_to_json(packed_mask(value, at()));
    }

    std::string place_, way_;
    int depth_ = 0;
};

}  // namespace

std::string type_text(const py::handle& object) {
    if (!py::isinstance<py::array>(object)) return py::str(py::type::of(object).attr("__name__"));
    return py::str("{} of shape {}").format(object.attr("dtype"), object.attr("shape"));
}

Json to_json(const py::object& object, const std::string& place) {
    ism::expect(py::hasattr(object, "keys"), place, "a dict", type_text(object));
    return ToJson(place).object(object);
}

py::object to_python(const Json& json) {
    return py::module_::import("json").attr("loads")(ism::detail::dump_json(json, "results"));
}

void warn(const std::string& text) {
    if (PyErr_WarnEx(PyExc_UserWarning, text.c_str(), 1) != 0) throw py::error_already_set();
}

}  // namespace ism_python
