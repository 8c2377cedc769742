// SPDX-License-Identifier: GPL-2.0-or-later
//
// io_control.hh - emergency stop chain, coolant, tool changer: HAL component iocontrol.0.
//
// Handshakes are levels: an output rises with the request and falls when its answer is
// seen; `cycle` looks at the answers once a task cycle. io.status tells: EXEC while an
// answer is awaited, ERROR when the tool table could not be written, else DONE.
// [task] Source: tools sheet, sections 3 to 10; task sheet, section 9.
#ifndef KERF_IO_CONTROL_HH
#define KERF_IO_CONTROL_HH

#include <string>
#include <vector>

#include "hal.h"
#include "inifile.hh"
#include "messages.hh"
#include "tooldata.h"

class IoControl {
public:
    const std::string &table() const { return table_; } // the tool table's file, empty: none
    int changing_to() const; // the tool that the changer puts into the spindle now, 0 none; -1: it does not work
    explicit IoControl(EMC_STAT &stat) : stat_(stat) {}
    ~IoControl();

    // Empty tool data and the HAL component; false with a message on failure. Before motion starts.
    bool create(const linuxcnc::IniFile &ini);
    // Loads the tool table and resets the outputs.
    void init();

    void cycle(); // samples the inputs: once per task cycle

    void estop_on();
    void estop_off();
    int prepare(int toolno);
    int load();
    int unload();
    int load_table(const char *file);
    int set_offset(const EMC_TOOL_SET_OFFSET &m);
    int set_number(int idx);
    int flood(bool on);
    int mist(bool on);
    void abort(int reason);

    // What went wrong with the tool table since the last call, for the operator.
    std::vector<std::string> news();

    std::vector<double> tool_change_position; // [EMCIO]TOOL_CHANGE_POSITION: 0, 3, 6 or 9 values
    bool changing() const { return *pins_->tool_change; } // a change waits for tool-changed
    bool random() const { return random_; }

private:
    struct Pins {
        hal_bit_t *user_enable_out, *emc_enable_in, *user_request_enable, *coolant_mist, *coolant_flood;
        hal_s32_t *tool_prep_pocket, *tool_prep_number, *tool_prep_index, *tool_from_pocket, *tool_number;
        hal_bit_t *tool_prepare, *tool_prepared, *tool_change, *tool_changed;
    };
    bool read_change_position(const linuxcnc::IniFile &ini);
    bool move_tool(int idx);
    bool save_table();
    bool load_file(const std::string &file);
    void take_problems();
    bool tell_database(tool_notify_t what, int toolno, int pocketno, const CANON_TOOL_TABLE &rec);
    EMC_STAT &stat_;
    Pins *pins_ = nullptr;
    int comp_ = -1;
    bool random_ = false, database_ = false;
    std::string table_;
    std::vector<std::string> news_;
};

#endif
