// Nothing of its own: the headers that cmake/hookpoint_precompiled.cmake precompiles need a target.
