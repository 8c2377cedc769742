// SPDX-License-Identifier: GPL-2.0-or-later
//
// stream.cc - Python access to HAL streams and to raw shared memory.

#include "component.h"

#include <cerrno>
#include <cstring>

namespace halpy {
namespace {

[[noreturn]] void throw_os_error(int negative_errno)
{
    errno = -negative_errno;
    PyErr_SetFromErrno(PyExc_OSError);
    throw py::error_already_set();
}

class Stream {
public:
    Stream(std::shared_ptr<Component> comp, int key, py::args args) : comp_(std::move(comp)), key_(key)
    {
        int result;
        if (args.size() == 2) {
            creator_ = true;
            std::string types = py::cast<std::string>(args[1]);
            long long depth = py::cast<long long>(args[0]);
            result = depth < 1 || depth > RTAPI_INT32_MAX
                         ? -EINVAL
                         : hal_stream_create(&stream_, comp_->id(), key, static_cast<unsigned>(depth), types.c_str());
        } else if (args.size() < 2) {
            std::string types = args.size() ? py::cast<std::string>(args[0]) : "";
            result = hal_stream_attach(&stream_, comp_->id(), key, args.size() ? types.c_str() : nullptr);
        } else {
            throw py::type_error("stream() takes 2 to 4 arguments");
        }
        if (result < 0) throw_os_error(result);
        open_ = true;
        for (int i = 0; i < hal_stream_element_count(&stream_); i++)
            types_.push_back(hal_stream_element_type(&stream_, i));
    }
    ~Stream()
    {
        if (!open_ || !hal_is_init()) return;
        if (creator_) hal_stream_destroy(&stream_);
        else hal_stream_detach(&stream_);
    }

    py::object read()
    {
        hal_stream_data_u data[HAL_STREAM_MAX_PINS];
        if (hal_stream_read(&stream_, data, &sampleno_) < 0) return py::none();
        py::tuple record(types_.size());
        for (size_t i = 0; i < types_.size(); i++) record[i] = to_python(cell_get(&data[i], types_[i]), types_[i]);
        return record;
    }

    void write(py::tuple record)
    {
        /* The texts are those of the classic module: they speak of the elements that the types stand for. */
        if (record.size() > types_.size()) throw py::value_error("Too few elements to unpack");
        if (record.size() < types_.size()) throw py::value_error("Too many elements to unpack");
        hal_stream_data_u data[HAL_STREAM_MAX_PINS];
        for (size_t i = 0; i < types_.size(); i++)
            cell_set(&data[i], types_[i], from_python(record[i], types_[i], "stream element " + std::to_string(i)));
        int result = hal_stream_write(&stream_, data);
        if (result < 0) throw_os_error(result);
    }

    hal_stream_t *raw() { return &stream_; }
    unsigned sampleno() const { return sampleno_; }
    py::bytes element_types() const
    {
        std::string letters;
        for (hal_type_t t : types_)
            letters += t == HAL_BIT     ? 'b'
                       : t == HAL_FLOAT ? 'f'
                       : t == HAL_S32   ? 's'
                       : t == HAL_U32   ? 'u'
                       : t == HAL_S64   ? 'l'
                                        : 'k';
        return letters;
    }
    std::string repr() const
    {
        char text[64];
        snprintf(text, sizeof text, "<stream 0x%x%s>", static_cast<unsigned>(key_), creator_ ? " creator" : "");
        return text;
    }

private:
    std::shared_ptr<Component> comp_;
    int key_;
    hal_stream_t stream_ = {};
    bool open_ = false, creator_ = false;
    unsigned sampleno_ = 0;
    std::vector<hal_type_t> types_;
};

// Raw shared memory; kept for old programs.
class Shm {
public:
    Shm(std::shared_ptr<Component> comp, int key, unsigned long size) : comp_(std::move(comp)), key_(key), size_(size)
    {
        PySys_WriteStderr("halmodule: hal.shm has been deprecated.\n");
        id_ = rtapi_shmem_new(key, comp_->id(), size);
        if (id_ < 0) throw_os_error(id_);
        int result = rtapi_shmem_getptr(id_, &mem_);
        if (result < 0) throw_os_error(result);
    }
    ~Shm()
    {
        if (id_ >= 0) rtapi_shmem_delete(id_, 0);
    }
    void setsize(unsigned long size)
    {
        if (size > size_) throw py::value_error("size exceeds that of the segment");
        size_ = size;
    }
    py::memoryview view() { return py::memoryview::from_memory(mem_, static_cast<py::ssize_t>(size_)); }
    py::buffer_info info()
    {
        return py::buffer_info(static_cast<unsigned char *>(mem_), static_cast<py::ssize_t>(size_));
    }
    std::string repr() const
    {
        char text[96];
        snprintf(text, sizeof text, "<shared memory buffer key=%08x id=%d size=%lu>", static_cast<unsigned>(key_), id_,
                 size_);
        return text;
    }

private:
    std::shared_ptr<Component> comp_;
    int key_, id_ = -1;
    unsigned long size_;
    void *mem_ = nullptr;
};

} // namespace

void bind_stream(py::module_ &m)
{
    using namespace py::literals;
    py::class_<Stream>(
        m, "stream", "stream(component, key, depth, types) makes a stream, stream(component, key[, types]) opens one.")
        .def(py::init<std::shared_ptr<Component>, int, py::args>())
        .def("read", &Stream::read, "The oldest record as a tuple, or None.")
        .def("write", &Stream::write, "record"_a, "Queues one record (a tuple); OSError ENOSPC when full.")
        .def_property_readonly("readable", [](Stream &s) { return hal_stream_readable(s.raw()); })
        .def_property_readonly("writable", [](Stream &s) { return hal_stream_writable(s.raw()); })
        .def_property_readonly("depth", [](Stream &s) { return hal_stream_depth(s.raw()); })
        .def_property_readonly("maxdepth", [](Stream &s) { return hal_stream_maxdepth(s.raw()); })
        .def_property_readonly("num_overruns", [](Stream &s) { return hal_stream_num_overruns(s.raw()); })
        .def_property_readonly("num_underruns", [](Stream &s) { return hal_stream_num_underruns(s.raw()); })
        .def_property_readonly("element_types", &Stream::element_types)
        .def_property_readonly("sampleno", &Stream::sampleno)
        .def("__repr__", &Stream::repr);
    py::class_<Shm>(m, "shm", py::buffer_protocol(), "Raw shared memory. Deprecated.")
        .def(py::init<std::shared_ptr<Component>, int, unsigned long>(), "component"_a, "key"_a, "size"_a)
        .def("getbuffer", &Shm::view)
        .def("setsize", &Shm::setsize, "size"_a)
        .def_buffer(&Shm::info)
        .def("__repr__", &Shm::repr);
}

} // namespace halpy
