/// The public face of what goes between processes.
#include "comm/comm.h"

#include <scree/run.h>

bool scree_processes_can_join(void)
{
    return scree_comm_has_transport();
}

scree_status scree_processes_join(int *count, scree_error *error)
{
    const scree_status status = scree_comm_join(error);
    *count = scree_comm_size();
    return status;
}

int scree_processes_number(void)
{
    return scree_comm_rank();
}

scree_status scree_processes_agree(scree_status status, scree_error *error)
{
    return scree_comm_agree(status, error);
}

void scree_processes_leave(void)
{
    scree_comm_leave();
}
