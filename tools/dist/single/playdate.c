/* SPDX-License-Identifier: MIT */
/* A converted model on a Playdate, animated and blurred. */
#include "fox.h"

static int update(void *user)
{
    (void)user;
    return fox_frame() == SMEAR_OK;
}

#ifdef _WINDLL
__declspec(dllexport)
#endif
int eventHandler(PlaydateAPI *api, PDSystemEvent event, uint32_t argument);
int eventHandler(PlaydateAPI *api, PDSystemEvent event, uint32_t argument)
{
    (void)argument;
    if (event != kEventInit)
        return 0;
    playdate = api;
    const int result = fox_begin();
    if (result == SMEAR_OK)
        api->system->setUpdateCallback(update, NULL);
    else
        api->system->logToConsole("%s", smear_error_text(result));
    return 0;
}
