function flags = collect(status, ready)
%#codegen
flags = uint32(0);
if status == LevelStatus.LEVEL_LOST
    flags = bitor(flags, bitshift(uint32(1), 2));
elseif status == LevelStatus.LEVEL_LOW
    flags = bitor(flags, bitshift(uint32(1), 0));
end
if ~ready
    flags = bitor(flags, uint32(8));
end
