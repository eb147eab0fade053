function y = isLost(now, stamp)
% Whole seconds: integer division rounds to the nearest.
dt_s = (now - stamp) / 1000;
if stamp == 0
    y = false;
    return;
end
y = dt_s >= 1;
end
