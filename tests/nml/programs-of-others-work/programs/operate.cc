// A client in C++, as people write them: homes the machine and moves it.
#include <stdio.h>
#include <string.h>

#include "rcs.hh"
#include "emc.hh"
#include "emc_nml.hh"
#include "nml_oi.hh"

static RCS_CMD_CHANNEL *emcCommandBuffer;
static RCS_STAT_CHANNEL *emcStatusBuffer;
static NML *emcErrorBuffer;
static EMC_STAT *emcStatus;
static int emcCommandSerialNumber;

static int updateStatus() {
    NMLTYPE type = emcStatusBuffer->peek();
    return type == -1 || (type != 0 && type != EMC_STAT_TYPE) ? -1 : 0;
}

static int emcCommandWaitDone() {
    for (double start = etime(); etime() - start < 60.0; esleep(0.01)) {
        updateStatus();
        int serial_diff = emcStatus->echo_serial_number - emcCommandSerialNumber;
        if (serial_diff > 0) return 0;
        if (serial_diff == 0 && emcStatus->status == RCS_DONE) return 0;
        if (serial_diff == 0 && emcStatus->status == RCS_ERROR) return -1;
    }
    return -2;
}

static int emcCommandSend(RCS_CMD_MSG &cmd) {
    if (emcCommandBuffer->write(&cmd)) return -1;
    emcCommandSerialNumber = cmd.serial_number;
    return emcCommandWaitDone();
}

static int sendMdi(const char *mdi) {
    EMC_TASK_PLAN_EXECUTE msg;
    strcpy(msg.command, mdi);
    return emcCommandSend(msg);
}

static void printErrors() {
    for (;;) switch (NMLTYPE type = emcErrorBuffer->read()) {
    case -1: case 0: return;
    case EMC_OPERATOR_ERROR_TYPE: printf("error: %s\n", ((EMC_OPERATOR_ERROR *)(emcErrorBuffer->get_address()))->error); break;
    case EMC_OPERATOR_TEXT_TYPE: printf("text: %s\n", ((EMC_OPERATOR_TEXT *)(emcErrorBuffer->get_address()))->text); break;
    case EMC_OPERATOR_DISPLAY_TYPE: printf("display: %s\n", ((EMC_OPERATOR_DISPLAY *)(emcErrorBuffer->get_address()))->display); break;
    case NML_ERROR_TYPE: printf("nml error: %s\n", ((NML_ERROR *)(emcErrorBuffer->get_address()))->error); break;
    default: printf("unknown %d\n", type);
    }
}

int main(int argc, char **argv) {
    const char *emc_nmlfile = argc > 1 ? argv[1] : NULL;
    emcCommandBuffer = new RCS_CMD_CHANNEL(emcFormat, "emcCommand", "xemc", emc_nmlfile);
    emcStatusBuffer = new RCS_STAT_CHANNEL(emcFormat, "emcStatus", "xemc", emc_nmlfile);
    emcErrorBuffer = new NML(nmlErrorFormat, "emcError", "xemc", emc_nmlfile);
    if (!emcCommandBuffer->valid() || !emcStatusBuffer->valid() || !emcErrorBuffer->valid()) return 1;
    emcStatus = (EMC_STAT *)emcStatusBuffer->get_address();
    for (int i = 0; i < 100 && (updateStatus() || emcStatus->_type != EMC_STAT_TYPE); i++) esleep(0.1);

    EMC_TASK_SET_STATE state;
    state.state = EMC_TASK_STATE_ESTOP_RESET;
    printf("reset %d", emcCommandSend(state));
    state.state = EMC_TASK_STATE_ON;
    printf(" on %d", emcCommandSend(state));
    EMC_TRAJ_SET_TELEOP_ENABLE teleop;
    teleop.enable = 0;
    printf(" joint %d", emcCommandSend(teleop));
    EMC_JOINT_HOME home;
    home.joint = -1;
    printf(" home %d", emcCommandSend(home));
    while (!emcStatus->motion.joint[0].homed || !emcStatus->motion.joint[1].homed || !emcStatus->motion.joint[2].homed) {
        esleep(0.05);
        updateStatus();
    }
    EMC_TASK_SET_MODE mode;
    mode.mode = EMC_TASK_MODE_MDI;
    printf(" mdi %d\n", emcCommandSend(mode));
    printf("G0 %d", sendMdi("G0 X1 Y2 Z-3"));
    updateStatus();
    EmcPose &p = emcStatus->motion.traj.position;
    printf(" at %.3f %.3f %.3f, tool %d, units %g\n", p.tran.x, p.tran.y, p.tran.z, emcStatus->io.tool.toolInSpindle, emcStatus->motion.traj.linearUnits);
    printf("wrong %d", sendMdi("G0 X9999"));
    printf(", message %d\n", sendMdi("(MSG,hello)"));
    printErrors();
    delete emcErrorBuffer;
    delete emcStatusBuffer;
    delete emcCommandBuffer;
    return 0;
}
