/* SPDX-License-Identifier: GPL-2.0-or-later
 *
 * hm2_eth_models.c - the boards that are known by name: connectors, and names of their pins.
 */
#include <string.h>
#include "hm2_eth.h"
#include "hm2_db25.h"

#define SERIAL(j, n) j "-RX" n, j "-TX" n, j "-TXEN" n
/* Encoder inputs of 7I95 and 7I97. */
#define ENCODERS \
    "TB1-01/TB1-09", "TB1-04/TB1-12", "TB1-07/TB1-15", "TB1-17/TB2-01", "TB1-20/TB2-04", "TB1-23/TB2-07", \
    "TB2-09/TB2-17", "TB2-12/TB2-20", "TB2-15/TB2-23"
#define TB5 \
    "TB5-13/TB5-14", "TB5-15/TB5-16", "TB5-17/TB5-18", "TB5-19/TB5-20", "TB5-21/TB5-22", "TB5-23/TB5-24"

static const char *const io_7i94[] = {
    DB25("P2"), SERIAL("J6", "0"), SERIAL("J7", "1"), SERIAL("J8", "2"), SERIAL("J9", "3"), SERIAL("J4", "4"),
    SERIAL("J3", "5"), SERIAL("J2", "6"), SERIAL("J1", "7"), "P2-/IOENA",
};
static const char *const io_7i95[] = {
    "TB3-02/TB3-03", "TB3-04/TB3-05", "TB3-08/TB3-09", "TB3-10/TB3-11", "TB3-14/TB3-15", "TB3-16/TB3-17",
    "TB3-20/TB3-21", "TB3-22/TB3-23", "TB4-02/TB4-03", "TB4-04/TB4-05", "TB4-08/TB4-09", "TB4-10/TB4-11",
    "TB4-14/TB4-15", "TB4-16/TB4-17", "TB3-16/TB3-17", "TB4-20/TB4-21", "TB4-22/TB4-23", "TB4-22/TB4-23",
    ENCODERS, "Internal EncMux", "Internal InMux0", "Internal InMux1", "Internal InMux2", "Internal InMux3",
    "Internal InMux4", "Internal InMuxData", TB5, "internal", DB25("P1"),
};
static const char *const io_7i96[] = {
    "TB3-01", "TB3-02", "TB3-03", "TB3-04", "TB3-05", "TB3-06", "TB3-07", "TB3-08", "TB3-09", "TB3-10", "TB3-11",
    "TB3-13/TB3-14", "TB3-15/TB3-16", "TB3-17/TB3-18", "TB3-19/TB3-20", "TB3-21/TB3-22", "TB3-23/TB3-24",
    "TB1-02/TB1-03", "TB1-04/TB1-05", "TB1-08/TB1-09", "TB1-10/TB1-11", "TB1-14/TB1-15", "TB1-16/TB1-17",
    "TB1-20/TB1-21", "TB1-22-TB1-23", "TB2-02/TB2-03", "TB2-04/TB2-05", "TB2-07/TB2-08", "TB2-10/TB2-11",
    "TB2-13/TB2-14", "TB2-16/TB2-17", "TB2-18/TB2-19", "internal", "internal", DB25("P1"),
};
static const char *const io_7i97[] = {
    "TB3-04", "TB3-08", "TB3-12", "TB3-16", "TB3-20", "AN_ENA4", "TB3-24", "AN_ENA5", "AN-ENA0..3", ENCODERS,
    "Internal EncMux", TB5, "Internal InMux0", "Internal InMux1", "Internal InMux2", "Internal InMux3",
    "Internal InMuxData", "TB4-15/TB4-16", "TB4-17/TB4-18", "TB4-17/TB4-18", DB25("P1"),
};
static const char *const io_mc04[] = {
    "Relay2", "Relay3", "Relay4", "Relay5", "Relay1", "Single led", "Enc#0 B", "Enc#0 A", "Enc#1 A", "Enc#0 Index",
    "Servo0VRDY", "StepGen #0 Step", "StepGen #0 Direction", "StepGen #1 Step", "StepGen #1 Direction",
    "StepGen #2 Step", "StepGen #2 Direction", "StepGen #3 Step", "StepGen #3 Direction", "Enc#2 B", "Enc#2 A",
    "Enc#1 Index", "Enc#1 B", "Servo1VRDY", "Servo2VRDY", "Enc#3 Index", "Enc#3 B", "Enc#3 A", "Enc#2 Index",
    "Servo3VRDY", "Servo's on", "Output0", "Output1", "Output2", "Output3", "Output4", "Output5", "Output6",
    "Output7", "Input7", "Input6", "Input5", "Input4", "Input3", "Input2", "Input1", "Input0", "PWMGen #0 Out0",
    "PWMGen #0 Not-Enable", "Spindle-on", "Spindle-ccw", "SSerial txen2", "SSerial tx2", "SSerial rx2",
    "SSerial txen1", "SSerial tx1", "SSerial rx1", "SSerial txen0", "SSerial tx0", "SSerial rx0",
};
#define UNUSED6 "Not used", "Not used", "Not used", "Not used", "Not used", "Not used"
static const char *const io_8css[] = {
    UNUSED6, "SSerial tx1", "SSerial rx1", "SSerial txen1", "SSerial tx2", "SSerial rx2", "SSerial txen2",
    "SSerial tx3", "SSerial rx3", "SSerial txen3", "SSerial tx4", "SSerial rx4", "SSerial txen4", "Input0", "Input1",
    "Input2", "Input3", "Input4", "Input5", "Input6", "Input7", UNUSED6, "Output2", "Output1", "Output0", "Output5",
    "Output4", "Output3", "Output7", "Output6", "Not used", "Not used", "Not used", "Not used", "Spindle CW",
    "Spindle PWM", "Spindle enable", "Spindle CCW", "SSerial tx8", "SSerial rx8", "SSerial txen8", "SSerial rx7",
    "SSerial tx7", "SSerial txen5", "SSerial rx5", "SSerial tx5", "SSerial txen6", "SSerial rx6", "SSerial tx6",
    "SSerial txen7",
};

#define IO(names) names, HM2_IO_COUNT(names)
#define HM2_IO_COUNT(names) (int)(sizeof(names) / sizeof((names)[0]))

/* In the order in which names are compared; 8 characters: the name is exactly that. */
static const struct eth_model models[] = {
    {"7I80DB-16", 9, "7i80", 4, 17, {"J2", "J3", "J4", "J5"}, "XC6SLX16", 4, NULL, 0},
    {"7I80DB-25", 9, "7i80", 4, 17, {"J2", "J3", "J4", "J5"}, "XC6SLX25", 4, NULL, 0},
    {"7I80HD-16", 9, "7i80", 3, 24, {"P1", "P2", "P3"}, "XC6SLX16", 4, NULL, 0},
    {"7I80HD-25", 9, "7i80", 3, 24, {"P1", "P2", "P3"}, "XC6SLX25", 4, NULL, 0},
    {"7I80HDT", 7, "7i80", 3, 24, {"P1", "P2", "P3"}, "T20F256", 4, NULL, 0},
    {"7I76E-16", 8, "7i76e", 3, 17, {"P1", "P2", "P3"}, "XC6SLX16", 4, NULL, 0},
    {"7I76EU", 8, "7i76e", 3, 17, {"P1", "P2", "P3"}, "T20F256", 4, NULL, 0},
    {"7I92", 4, "7i92", 2, 17, {"P2", "P1"}, "XC6SLX9", 4, NULL, 0},
    {"7I93", 4, "7i93", 2, 24, {"P2", "P1"}, "6slx9tqg144", 4, NULL, 0},
    {"7I94", 8, "7i94", 2, 21, {"P2", "J1,J4"}, "6slx9tqg144", 4, IO(io_7i94)},
    {"7I94T", 8, "7i94", 2, 21, {"P2", "J1,J4"}, "T20F256", 4, IO(io_7i94)},
    {"7I95", 8, "7i95", 2, 29, {"P1", "TB1"}, "6slx9tqg144", 4, IO(io_7i95)},
    {"7I95T", 8, "7i95", 2, 29, {"P1", "TB1"}, "T20F256", 4, IO(io_7i95)},
    {"7I96", 8, "7i96", 3, 17, {"P1", "TB1", "TB2"}, "6slx9tqg144", 4, IO(io_7i96)},
    {"7I96S", 8, "7i96s", 3, 17, {"P1", "TB1", "TB2"}, "T20F256", 4, IO(io_7i96)},
    {"7I97", 8, "7i97", 3, 17, {"P1", "TB1", "TB2"}, "6slx9tqg144", 4, IO(io_7i97)},
    {"7I97T", 8, "7i97", 3, 17, {"P1", "TB1", "TB2"}, "T20F256", 4, IO(io_7i97)},
    {"7I98", 4, "7i98", 3, 17, {"P1", "P2", "P3"}, "6slx9tqg144", 4, NULL, 0},
    {"MC04", 4, "mc04", 2, 30, {"P1", "P2"}, "6slx9tqg144", 4, IO(io_mc04)},
    {"8CSS", 4, "8css", 2, 30, {"P1", "P2"}, "6slx9tqg144", 4, IO(io_8css)},
};

const struct eth_model *eth_find_model(const char *name)
{
    size_t i;
    for(i = 0; i < sizeof models / sizeof models[0]; i++)
        if(!strncmp(name, models[i].name, (size_t)models[i].compared)) return &models[i];
    return NULL;
}
